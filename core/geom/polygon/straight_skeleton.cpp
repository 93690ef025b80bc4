#include "core/geom/polygon/straight_skeleton.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>

#include "core/geom/polygon/near_groups.h"
#include "core/geom/polygon/wavefront.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// Shares of the diagonal of the plan. Nodes nearer than the first are equal. Nodes farther than the second
// from the plane of their face, and edges that cross by more than the third, are errors.
constexpr double same_node = 4e-9;
constexpr double off_plane = 1e-6;
constexpr double crossing = 1e-7;
// The tolerated difference of areas, as a share.
constexpr double area_share = 1e-6;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

double twice_area(std::span<const dvec2> outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  }
  return sum;
}

/// Joins the borders of one face to outlines. It works in the plane of the face: the direction of the edge,
/// and time.
class FaceMaker {
 public:
  FaceMaker(const std::vector<dvec3>& nodes, const Wavefront::Source& source, double scale)
      : nodes_(nodes), source_(source), scale_(scale) {}

  /// False: the borders do not make a face.
  bool make(std::vector<Wavefront::Border> borders, std::vector<SkeletonFace>& faces) {
    drop_there_and_back(borders);
    std::vector<std::vector<std::uint32_t>> outlines, holes;
    for (const std::vector<std::uint32_t>& loop : loops_of(borders)) {
      const std::vector<dvec2> flat = flatten(loop);
      if (!is_simple(flat)) return false;
      for (const std::uint32_t node : loop) {
        const dvec3 p = nodes_[node];
        const double off = glm::dot(source_.normal, dvec2(p)) - source_.offset - source_.speed * p.z;
        if (!(std::abs(off) <= off_plane * scale_)) return false;
      }
      (twice_area(flat) > 0 ? outlines : holes).push_back(loop);
    }
    if (outlines.empty()) return holes.empty();
    const std::size_t first = faces.size();
    for (auto& outline : outlines) {
      faces.push_back({source_.edge, source_.is_step, std::move(outline), {}});
    }
    for (auto& hole : holes) {
      const auto owner =
          std::find_if(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(),
                       [&](const SkeletonFace& face) { return is_within(flat_of(hole[0]), face.outline); });
      if (owner == faces.end()) return false;
      owner->holes.push_back(std::move(hole));
    }
    return true;
  }

 private:
  dvec2 flat_of(std::uint32_t node) const {
    return {glm::dot(source_.direction, dvec2(nodes_[node])), nodes_[node].z};
  }
  std::vector<dvec2> flatten(const std::vector<std::uint32_t>& loop) const {
    std::vector<dvec2> flat;
    for (const std::uint32_t node : loop) flat.push_back(flat_of(node));
    return flat;
  }

  static void drop_there_and_back(std::vector<Wavefront::Border>& borders) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& b : borders) {
      if (b.from != b.to) balance[std::minmax(b.from, b.to)] += b.from < b.to ? 1 : -1;
    }
    std::erase_if(borders, [&](const Wavefront::Border& b) {
      if (b.from == b.to) return true;
      int& left = balance[std::minmax(b.from, b.to)];
      const int way = b.from < b.to ? 1 : -1;
      if (left * way <= 0) return true;
      left -= way;
      return false;
    });
  }

  std::vector<std::vector<std::uint32_t>> loops_of(const std::vector<Wavefront::Border>& borders) const {
    std::multimap<std::uint32_t, std::size_t> leaving;
    for (std::size_t i = 0; i < borders.size(); ++i) leaving.emplace(borders[i].from, i);
    std::vector<bool> is_used(borders.size(), false);
    std::vector<std::vector<std::uint32_t>> loops;
    for (std::size_t first = 0; first < borders.size(); ++first) {
      if (is_used[first]) continue;
      std::vector<std::uint32_t> loop;
      for (std::size_t at = first; !is_used[at];) {
        is_used[at] = true;
        loop.push_back(borders[at].from);
        const auto [low, high] = leaving.equal_range(borders[at].to);
        double best = 10;
        std::size_t next = first;
        for (auto it = low; it != high; ++it) {
          if (is_used[it->second] && it->second != first) continue;
          const double turn = clockwise(borders[at], borders[it->second]);
          if (turn < best) {
            best = turn;
            next = it->second;
          }
        }
        at = next;
      }
      if (loop.size() > 2) loops.push_back(std::move(loop));
    }
    return loops;
  }

  /// Rises with the angle, clockwise, from the way back along `in` to `out`: 0 to 4.
  double clockwise(const Wavefront::Border& in, const Wavefront::Border& out) const {
    const dvec2 back = flat_of(in.from) - flat_of(in.to), on = flat_of(out.to) - flat_of(out.from);
    const double x = glm::dot(back, on), y = -cross(back, on);
    const double share = y / std::max(std::abs(x) + std::abs(y), 1e-300);
    if (x < 0) return 2 - share;
    return y <= 0 ? 4 + share : share;
  }

  bool is_within(const dvec2& p, const std::vector<std::uint32_t>& loop) const {
    bool is_inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const dvec2 a = flat_of(loop[i]), b = flat_of(loop[(i + 1) % loop.size()]);
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
        is_inside = !is_inside;
    }
    return is_inside;
  }

  /// Whether no two of its edges cross.
  bool is_simple(const std::vector<dvec2>& loop) const {
    const std::size_t count = loop.size();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto low = [&](std::size_t i) { return std::min(loop[i].x, loop[(i + 1) % count].x); };
    const auto high = [&](std::size_t i) { return std::max(loop[i].x, loop[(i + 1) % count].x); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair{low(a), a} < std::pair{low(b), b};
    });
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = i + 1; k < count && low(order[k]) <= high(order[i]); ++k) {
        const std::size_t p = order[i], q = order[k];
        if (do_cross(loop[p], loop[(p + 1) % count], loop[q], loop[(q + 1) % count])) return false;
      }
    }
    return true;
  }

  bool do_cross(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d) const {
    const double least_ab = crossing * scale_ * glm::length(b - a),
                 least_cd = crossing * scale_ * glm::length(d - c);
    const double c_off = cross(b - a, c - a), d_off = cross(b - a, d - a);
    const double a_off = cross(d - c, a - c), b_off = cross(d - c, b - c);
    const auto are_apart = [](double p, double q, double least) {
      return (p > least && q < -least) || (p < -least && q > least);
    };
    return are_apart(c_off, d_off, least_ab) && are_apart(a_off, b_off, least_cd);
  }

  const std::vector<dvec3>& nodes_;
  const Wavefront::Source& source_;
  double scale_;
};

double plan_area(const StraightSkeleton& skeleton, const std::vector<std::uint32_t>& loop) {
  std::vector<dvec2> points;
  for (const std::uint32_t node : loop) points.emplace_back(skeleton.node[node]);
  return 0.5 * twice_area(points);
}

bool is_area_kept(const StraightSkeleton& skeleton, double expected, double scale) {
  double area = 0;
  for (const SkeletonFace& face : skeleton.faces) {
    const double outer = plan_area(skeleton, face.outline);
    if (outer < -area_share * scale * scale) return false;
    area += outer;
    for (const auto& hole : face.holes) area += plan_area(skeleton, hole);
  }
  for (const SkeletonFront& front : skeleton.fronts) area += plan_area(skeleton, front.node);
  return std::abs(area - expected) <= area_share * scale * scale;
}

bool make_faces(Wavefront& front, StraightSkeleton& skeleton, const Job& job) {
  const std::vector<std::uint32_t> same = near_groups(front.nodes, same_node * front.scale, job);
  std::vector<std::vector<Wavefront::Border>> borders(front.sources.size());
  for (const Wavefront::Border& border : front.borders) {
    borders[border.source].push_back({border.source, same[border.from], same[border.to]});
  }
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (i % 64 == 0) job.check();
    FaceMaker maker(front.nodes, front.sources[i], front.scale);
    if (!maker.make(std::move(borders[i]), skeleton.faces)) return false;
  }
  std::stable_sort(skeleton.faces.begin(), skeleton.faces.end(),
                   [](const SkeletonFace& a, const SkeletonFace& b) { return a.edge < b.edge; });
  for (SkeletonFront& loop : front.fronts) {
    SkeletonFront kept;
    for (std::size_t i = 0; i < loop.node.size(); ++i) {
      const std::uint32_t node = same[loop.node[i]], next = same[loop.node[(i + 1) % loop.node.size()]];
      if (node == next) continue;
      kept.node.push_back(node);
      kept.edge.push_back(loop.edge[i]);
    }
    if (kept.node.size() > 2) skeleton.fronts.push_back(std::move(kept));
  }
  return true;
}

/// Whether all rings have at least three points and all edges have a length.
bool has_edges(const Plan& plan) {
  if (plan.rings.empty()) return false;
  for (const PlanRing& ring : plan.rings) {
    if (ring.size() < 3) return false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double length = glm::length(ring[(i + 1) % ring.size()] - ring[i]);
      if (!(length > 0) || !std::isfinite(length)) return false;
    }
  }
  return true;
}

/// The skeleton of a rectangle whose opposite edges have the same speed: a ridge, and a triangle or an upright end at
/// each of its ends. Nothing for other plans, squares, and fronts that stop before they meet.
std::optional<StraightSkeleton> skeleton_of_rectangle(const Plan& plan, const SkeletonOptions& options) {
  constexpr double clearly_less = 1 - 1e-6;
  if (plan.rings.size() != 1 || plan.rings[0].size() != 4) return std::nullopt;
  const PlanRing& p = plan.rings[0];
  const dvec2 u = p[1] - p[0], v = p[3] - p[0];
  if (p[2] - p[1] != v || p[2] - p[3] != u || glm::dot(u, v) != 0 || !(cross(u, v) > 0)) return std::nullopt;
  const auto speed = [&](std::size_t edge) { return options.speed.empty() ? 1.0 : options.speed[edge]; };
  if (speed(0) != speed(2) || speed(1) != speed(3)) return std::nullopt;
  // The times at which the edges 0 and 2, and 1 and 3, would meet.
  const double across = glm::length(v) / (2 * speed(0)), along = glm::length(u) / (2 * speed(1));
  const double time = std::min(across, along);
  if (!(time < clearly_less * std::max(across, along)) || !(time < clearly_less * options.end_time))
    return std::nullopt;
  StraightSkeleton skeleton;
  skeleton.is_sound = true;
  for (const dvec2& corner : p) skeleton.node.emplace_back(corner, 0);
  const auto add_face = [&skeleton](std::uint32_t edge, std::vector<std::uint32_t> outline) {
    skeleton.faces.push_back({edge, false, std::move(outline), {}});
  };
  if (across < along) {
    const dvec2 end = u * (speed(1) * time / glm::length(u));
    skeleton.node.emplace_back(p[1] + v / 2.0 - end, time);
    skeleton.node.emplace_back(p[0] + v / 2.0 + end, time);
    add_face(0, {0, 1, 4, 5});
    add_face(1, {1, 2, 4});
    add_face(2, {2, 3, 5, 4});
    add_face(3, {3, 0, 5});
  } else {
    const dvec2 end = v * (speed(0) * time / glm::length(v));
    skeleton.node.emplace_back(p[0] + u / 2.0 + end, time);
    skeleton.node.emplace_back(p[3] + u / 2.0 - end, time);
    add_face(0, {0, 1, 4});
    add_face(1, {1, 2, 5, 4});
    add_face(2, {2, 3, 5});
    add_face(3, {3, 0, 4, 5});
  }
  return skeleton;
}

}  // namespace

StraightSkeleton straight_skeleton(const Plan& plan, const SkeletonOptions& options, const Job& job) {
  StraightSkeleton skeleton;
  if (!has_edges(plan)) return skeleton;
  if (auto rectangle = skeleton_of_rectangle(plan, options)) return *std::move(rectangle);
  // Near the origin, where floating-point numbers are most precise.
  const dvec2 origin = plan.rings[0][0];
  Plan local = plan;
  double expected = 0;
  for (PlanRing& ring : local.rings) {
    for (dvec2& p : ring) p -= origin;
    expected += 0.5 * twice_area(ring);
  }
  Wavefront front(local, options, job);
  const bool has_met = front.run();
  if (has_met && make_faces(front, skeleton, job)) {
    skeleton.node = std::move(front.nodes);
    skeleton.is_sound = is_area_kept(skeleton, expected, front.scale);
  }
  for (dvec3& node : skeleton.node) node += dvec3(origin, 0);
  return skeleton;
}

}  // namespace seedmesh
