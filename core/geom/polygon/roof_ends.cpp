// The vertical ends of roofs; see roof.h.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geom/polygon/roof.h"
#include "core/geom/polygon/straight_skeleton.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Corners with smaller angles (as a sine) are straight.
constexpr double straight = 1e-6;

double turn_at(const dvec2& before, const dvec2& p, const dvec2& after) {
  const dvec2 a = p - before, b = after - p;
  return (a.x * b.y - a.y * b.x) / (glm::length(a) * glm::length(b));
}

/// A straight run of edges of one ring.
struct Side {
  std::vector<std::uint32_t> edges;
  std::uint32_t before = 0, after = 0;  ///< sides of the same ring
  double length = 0;
  bool is_convex = false;  ///< at both of its ends
};

/// The plan without points in the middle of straight edges, and its sides in order.
Plan straightened(const Plan& plan, std::vector<Side>& sides) {
  Plan made;
  std::uint32_t first_edge = 0;
  for (const PlanRing& ring : plan.rings) {
    const std::size_t count = ring.size();
    std::vector<double> turn;
    for (std::size_t i = 0; i < count; ++i)
      turn.push_back(turn_at(ring[(i + count - 1) % count], ring[i], ring[(i + 1) % count]));
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < count; ++i) {
      if (std::abs(turn[i]) > straight) corners.push_back(i);
    }
    const auto first_side = static_cast<std::uint32_t>(sides.size());
    const auto corner_count = static_cast<std::uint32_t>(corners.size());
    made.rings.emplace_back();
    for (std::uint32_t k = 0; k < corner_count; ++k) {
      const std::size_t from = corners[k], to = corners[(k + 1) % corner_count];
      Side side;
      for (std::size_t i = from; i != to; i = (i + 1) % count)
        side.edges.push_back(first_edge + static_cast<std::uint32_t>(i));
      side.before = first_side + (k + corner_count - 1) % corner_count;
      side.after = first_side + (k + 1) % corner_count;
      side.length = glm::length(ring[to] - ring[from]);
      side.is_convex = turn[from] > 0 && turn[to] > 0;
      sides.push_back(std::move(side));
      made.rings.back().push_back(ring[from]);
    }
    first_edge += static_cast<std::uint32_t>(count);
  }
  return made;
}

}  // namespace

std::vector<std::uint32_t> gable_edges(const Plan& plan, const Job& job) {
  std::vector<Side> sides;
  const Plan simple = straightened(plan, sides);
  const StraightSkeleton skeleton = straight_skeleton(simple, {}, job);
  if (!skeleton.is_sound) return {};
  std::vector<std::uint32_t> ends;
  for (const SkeletonFace& face : skeleton.faces) {
    if (face.outline.size() == 3 && sides[face.edge].is_convex) ends.push_back(face.edge);
  }
  std::stable_sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
    // Lengths that differ by rounding are equal.
    return sides[a].length < sides[b].length * (1 - 1e-9);
  });
  std::vector<bool> is_end(sides.size(), false);
  std::vector<std::uint32_t> edges;
  for (const std::uint32_t end : ends) {
    if (is_end[sides[end].before] || is_end[sides[end].after]) continue;
    is_end[end] = true;
    edges.insert(edges.end(), sides[end].edges.begin(), sides[end].edges.end());
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace seedmesh
