#include "core/geom/polygon/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/geom/polygon/segment_pairs.h"
#include "core/geom/polygon/triangulate.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Shares of the diagonal: points nearer than the first are one; edges nearer than the second touch.
constexpr double same_point = 1e-6;
constexpr double touching = 1e-7;
// A triangle or ring of less than this share of the squared diagonal has no area.
constexpr double no_area = 1e-14;
// Further errors are not reported.
constexpr std::size_t most_defects = 64;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

std::string name_of(std::uint32_t ring, std::uint32_t vertex) {
  return "point " + std::to_string(vertex) + " of ring " + std::to_string(ring);
}

struct Side {
  dvec2 from, to;
  std::uint32_t ring, vertex;
};

std::vector<Side> sides_of(const Plan& plan) {
  std::vector<Side> sides;
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    const PlanRing& ring = plan.rings[r];
    for (std::uint32_t i = 0; i < ring.size(); ++i)
      sides.push_back({ring[i], ring[(i + 1) % ring.size()], r, i});
  }
  return sides;
}

double distance_to(const dvec2& p, const Side& side) {
  const dvec2 along = side.to - side.from;
  const double share = std::clamp(glm::dot(p - side.from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - side.from - along * share);
}

bool do_meet(const Side& a, const Side& b, double reach) {
  const double c = cross(a.to - a.from, b.from - a.from), d = cross(a.to - a.from, b.to - a.from);
  const double e = cross(b.to - b.from, a.from - b.from), f = cross(b.to - b.from, a.to - b.from);
  if (((c > 0) != (d > 0)) && ((e > 0) != (f > 0))) return true;
  return distance_to(a.from, b) <= reach || distance_to(a.to, b) <= reach ||
         distance_to(b.from, a) <= reach || distance_to(b.to, a) <= reach;
}

/// Whether `next` runs back along the side before it.
bool turns_back(const Side& side, const Side& next, double reach) {
  return glm::dot(side.to - side.from, next.to - next.from) < 0 &&
         (distance_to(next.to, side) <= reach || distance_to(side.from, next) <= reach);
}

void find_ring_defects(const Plan& plan, double diagonal, std::vector<PlanDefect>& defects) {
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    const PlanRing& ring = plan.rings[r];
    const auto count = static_cast<std::uint32_t>(ring.size());
    if (count < 3) {
      defects.push_back({r, 0,
                         "ring " + std::to_string(r) + " has " + std::to_string(count) +
                             " points; an outline needs at least 3"});
      continue;
    }
    for (std::uint32_t i = 0; i < count && defects.size() < most_defects; ++i) {
      const std::uint32_t next = (i + 1) % count;
      if (glm::length(ring[next] - ring[i]) <= same_point * diagonal)
        defects.push_back({r, next, name_of(r, next) + " repeats the point before it"});
    }
    if (std::abs(signed_area(ring)) <= no_area * diagonal * diagonal)
      defects.push_back({r, 0, "ring " + std::to_string(r) + " has no area"});
  }
}

void find_meetings(const Plan& plan, double reach, const Job* job, std::vector<PlanDefect>& defects) {
  const std::vector<Side> sides = sides_of(plan);
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t i) { return std::min(sides[i].from.x, sides[i].to.x); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{low(a), a} < std::pair{low(b), b};
  });
  std::vector<Segment> segments;
  segments.reserve(order.size());
  for (const std::size_t i : order) segments.push_back({sides[i].from, sides[i].to});
  each_near_pair(segments, reach, job, [&](std::size_t i, std::size_t k) {
    const Side &a = sides[std::min(order[i], order[k])], &b = sides[std::max(order[i], order[k])];
    const std::size_t count = plan.rings[a.ring].size();
    const bool is_next = a.ring == b.ring && (a.vertex + 1) % count == b.vertex,
               is_before = a.ring == b.ring && (b.vertex + 1) % count == a.vertex;
    const bool is_fault = is_next     ? turns_back(a, b, reach)
                          : is_before ? turns_back(b, a, reach)
                                      : do_meet(a, b, reach);
    if (is_fault) {
      defects.push_back({b.ring, b.vertex,
                         "the edge from " + name_of(b.ring, b.vertex) + " crosses or touches the edge from " +
                             name_of(a.ring, a.vertex)});
    }
    return defects.size() < most_defects;
  });
}

void find_lost_holes(const Plan& plan, const Job* job, std::vector<PlanDefect>& defects) {
  std::vector<Plan> rings;
  std::vector<std::pair<dvec2, dvec2>> boxes;
  for (const PlanRing& ring : plan.rings) {
    dvec2 low = ring[0], high = low;
    for (const dvec2& p : ring) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    rings.push_back({{ring}});
    boxes.emplace_back(low, high);
  }
  const auto is_in = [&](std::size_t ring, const dvec2& p) {
    const auto& [low, high] = boxes[ring];
    return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y && contains(rings[ring], p);
  };
  for (std::uint32_t r = 1; r < plan.rings.size() && defects.size() < most_defects; ++r) {
    if (job) job->check();
    const dvec2 p = plan.rings[r][0];
    if (!is_in(0, p)) {
      defects.push_back({r, 0, "ring " + std::to_string(r) + " is a hole outside of ring 0"});
      continue;
    }
    for (std::uint32_t other = 1; other < plan.rings.size(); ++other) {
      if (other == r || !is_in(other, p)) continue;
      defects.push_back(
          {r, 0,
           "ring " + std::to_string(r) + " is a hole inside of the hole of ring " + std::to_string(other)});
      break;
    }
  }
}

}  // namespace

std::vector<PlanDefect> defects_of(const Plan& plan, const Job* job) {
  std::vector<PlanDefect> defects;
  if (plan.rings.empty()) return {{0, 0, "a plan needs at least one ring"}};
  for (std::uint32_t r = 0; r < plan.rings.size(); ++r) {
    for (std::uint32_t i = 0; i < plan.rings[r].size() && defects.size() < most_defects; ++i) {
      const dvec2 p = plan.rings[r][i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        defects.push_back({r, i, name_of(r, i) + " is not finite"});
    }
  }
  if (!defects.empty()) return defects;
  const double diagonal = diagonal_of(plan);
  find_ring_defects(plan, diagonal, defects);
  if (!defects.empty()) return defects;
  find_meetings(plan, touching * diagonal, job, defects);
  if (defects.empty()) find_lost_holes(plan, job, defects);
  return defects;
}

Plan read_plan(std::vector<PlanRing> rings) {
  Plan plan{std::move(rings)};
  for (std::size_t r = 0; r < plan.rings.size(); ++r) {
    PlanRing& ring = plan.rings[r];
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if ((signed_area(ring) < 0) == (r == 0)) std::reverse(ring.begin(), ring.end());
  }
  return plan;
}

double signed_area(std::span<const dvec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return 0.5 * twice;
}

double area(const Plan& plan) {
  double sum = 0;
  for (const PlanRing& ring : plan.rings) sum += signed_area(ring);
  return sum;
}

dvec2 centroid_of(std::span<const dvec2> ring) {
  dvec2 sum{0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += (a + b) * cross(a, b);
  }
  return ring[0] + sum / (6 * signed_area(ring));
}

std::uint32_t edge_count(const Plan& plan) {
  std::size_t count = 0;
  for (const PlanRing& ring : plan.rings) count += ring.size();
  return static_cast<std::uint32_t>(count);
}

std::pair<dvec2, dvec2> edge_of(const Plan& plan, std::uint32_t edge) {
  for (const PlanRing& ring : plan.rings) {
    if (edge < ring.size()) return {ring[edge], ring[(edge + 1) % ring.size()]};
    edge -= static_cast<std::uint32_t>(ring.size());
  }
  return {dvec2(0), dvec2(0)};
}

bool contains(const Plan& plan, const dvec2& p) {
  bool is_inside = false;
  for (const PlanRing& ring : plan.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (cross(b - a, p - a) == 0 && glm::dot(p - a, p - b) <= 0) return true;
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
        is_inside = !is_inside;
    }
  }
  return is_inside;
}

double diagonal_of(const Plan& plan) {
  if (plan.rings.empty() || plan.rings[0].empty()) return 0;
  dvec2 low = plan.rings[0][0], high = low;
  for (const dvec2& p : plan.rings[0]) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::length(high - low);
}

std::vector<std::uint32_t> triangulate(const Plan& plan, ThinTriangles thin, const Job* job) {
  if (plan.rings.empty()) return {};
  std::vector<dvec2> points;
  std::vector<std::uint32_t> ring_sizes;
  for (const PlanRing& ring : plan.rings) {
    points.insert(points.end(), ring.begin(), ring.end());
    ring_sizes.push_back(static_cast<std::uint32_t>(ring.size()));
  }
  const double diagonal = diagonal_of(plan);
  Triangulator triangulator(job);
  const double least_area = no_area * diagonal * diagonal;
  const std::span<const std::uint32_t> triangles = thin == ThinTriangles::drop && ring_sizes.size() == 1
                                                       ? triangulator.run(points, least_area)
                                                       : triangulator.run(points, ring_sizes, least_area);
  return {triangles.begin(), triangles.end()};
}

}  // namespace seedmesh
