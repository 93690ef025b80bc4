#include "core/generators/scene/candidate_positions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t placements_a_chunk = 4096;
constexpr std::uint64_t draw_rank = 4;

/// Returns a random vector, uniformly distributed over the disc of radius `most`.
glm::dvec2 drawn_offset(Rng& rng, double most) {
  if (most <= 0) return {0, 0};
  const double distance = most * std::sqrt(rng.unit());
  const math::SinCos direction = math::sincos(rng.uniform(0, 2 * math::pi));
  return {distance * direction.cos, distance * direction.sin};
}

}  // namespace

Issue shapes_issue(const std::string& what, double needed, const Job& job) {
  const std::uint64_t bound = job.limits().shapes;
  return limit_issue({Resource::shapes, bound, static_cast<std::uint64_t>(math::to_int64(needed))},
                     what + " more positions than " + std::to_string(bound) + ", the limit on shapes");
}

namespace {

void refuse_more_than(double most, const Job& job) {
  if (most > static_cast<double>(job.limits().shapes)) {
    job.refuse(shapes_issue("gives", most, job));
  }
}

/// Returns placements of a series, each from its own stream.
template <class PositionOf>
Array<Placement> series(SeriesRange range, Rng rng, const Job& job, const PositionOf& position) {
  refuse_more_than(static_cast<double>(range.count), job);
  Array<Placement> placements(job, range.count, Placement{});
  parallel_for(job, range.count, placements_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin; i < end; ++i) {
      Rng own = rng.at(range.first + i);
      placements[i].key = own.key();
      placements[i].at = position(own);
    }
  });
  return placements;
}

/// Returns the distance from the centre of a part to the farthest position of the rows that cover it.
double reach_of(const Extent& part, const RowPlan& plan) {
  return glm::length(part.size()) / 2 + plan.jitter;
}

glm::dvec2 drawn_position(const Extent& part, Rng& rng) {
  const double x = rng.uniform(part.min.x, part.max.x);
  return {x, rng.uniform(part.min.y, part.max.y)};
}

}  // namespace

Array<Placement> scattered(const Extent& part, SeriesRange range, Rng rng, const Job& job) {
  return series(range, rng, job, [&](Rng& own) { return drawn_position(part, own); });
}

Array<Placement> clustered(const Extent& part, const ClusterPlan& plan, SeriesRange range, Rng rng,
                           const Job& job) {
  std::vector<glm::dvec2> middles;
  for (std::size_t i = 0; i < plan.clusters; ++i) {
    Rng own = rng.at("middle").at(i);
    middles.push_back(drawn_position(part, own));
  }
  return series(range, rng, job, [&](Rng& own) {
    const glm::dvec2 middle = middles[own.below(static_cast<std::uint32_t>(middles.size()))];
    const double x = normal(own, 0, plan.radius);
    return middle + glm::dvec2(x, normal(own, 0, plan.radius));
  });
}

void refuse_rows(const Extent& part, const RowPlan& plan, const Job& job) {
  const double reach = reach_of(part, plan);
  refuse_more_than(std::ceil(4 * reach * reach / (plan.spacing.x * plan.spacing.y)) / 4, job);
}

Array<Placement> in_rows(const Extent& part, const RowPlan& plan, Rng rng, const Job& job) {
  const glm::dvec2 middle = (part.min + part.max) / 2.0;
  const double reach = reach_of(part, plan);
  refuse_rows(part, plan, job);
  const math::SinCos turn = math::sincos(plan.angle);
  // Counter-clockwise as seen from above, with z to the south.
  const glm::dvec2 onward(turn.cos, -turn.sin), aside(turn.sin, turn.cos);
  const std::int64_t rows = math::to_int64(std::ceil(reach / plan.spacing.y));
  const std::int64_t columns = math::to_int64(std::ceil(reach / plan.spacing.x)) + 1;
  Array<Placement> placements(job);
  for (std::int64_t row = -rows; row <= rows; ++row) {
    job.check();
    const double shift = row % 2 != 0 ? plan.stagger : 0;
    for (std::int64_t column = -columns; column <= columns; ++column) {
      Placement placement;
      const glm::dvec2 position = middle + onward * (plan.spacing.x * (static_cast<double>(column) + shift)) +
                                  aside * (plan.spacing.y * static_cast<double>(row));
      if (glm::any(glm::lessThan(position, part.min - plan.jitter)) ||
          glm::any(glm::greaterThan(position, part.max + plan.jitter)))
        continue;
      Rng own = rng.at(static_cast<std::uint64_t>(row)).at(static_cast<std::uint64_t>(column));
      placement.key = own.key();
      placement.turn = static_cast<float>(plan.angle);
      placement.at = position + drawn_offset(own, plan.jitter);
      if (part.contains(placement.at)) placements.push_back(placement);
    }
  }
  return placements;
}

void refuse_along(std::span<const glm::dvec2> points, const PathPlan& plan, const Job& job) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
  refuse_more_than(2 * length / plan.distance, job);
}

Array<Placement> along(std::span<const glm::dvec2> points, const PathPlan& plan, Rng rng, const Job& job) {
  refuse_along(points, plan, job);
  const bool both = plan.offset > 0 && plan.left && plan.right;
  Array<Placement> placements(job);
  double passed = 0, next = plan.distance / 2;
  std::uint64_t number = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    job.check();
    const double piece = glm::distance(points[i - 1], points[i]);
    if (piece <= 0) continue;
    const glm::dvec2 onward = (points[i] - points[i - 1]) / piece;
    const glm::dvec2 left(onward.y, -onward.x);
    for (; next <= passed + piece; next += plan.distance, ++number) {
      const glm::dvec2 middle = points[i - 1] + onward * (next - passed);
      for (int side = 0; side < 2; ++side) {
        if (!both && side == (plan.left ? 1 : 0)) continue;
        Rng own = rng.at(number).at(static_cast<std::uint64_t>(side));
        Placement placement;
        placement.key = own.key();
        placement.turn = static_cast<float>(math::atan2(-onward.y, onward.x));
        placement.at =
            middle + left * (side == 0 ? plan.offset : -plan.offset) + drawn_offset(own, plan.jitter);
        placements.push_back(placement);
      }
    }
    passed += piece;
  }
  return placements;
}

void keep(Array<Placement>& placements, const Array<std::uint8_t>& marks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    if (marks[i] != 0) placements[kept++] = placements[i];
  }
  placements.resize(kept);
}

void thin_out(Array<Placement>& placements, std::size_t most, const Job& job) {
  if (placements.size() <= most) return;
  Array<std::uint64_t> rank(job, placements.size());
  for (std::size_t i = 0; i < placements.size(); ++i) rank[i] = key_at(placements[i].key, draw_rank);
  Array<std::uint64_t> sorted(job);
  sorted.append(rank.span());
  std::uint64_t limit = 0;
  if (most > 0) {
    std::nth_element(sorted.begin(), sorted.begin() + (most - 1), sorted.begin() + sorted.size());
    limit = sorted[most - 1];
  }
  Array<std::uint8_t> marks(job, placements.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const bool stays = kept < most && rank[i] <= limit && most > 0;
    marks[i] = stays ? 1 : 0;
    kept += marks[i];
  }
  keep(placements, marks);
}

}  // namespace seedmesh::scene
