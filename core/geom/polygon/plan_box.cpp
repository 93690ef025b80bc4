// The smallest rectangle around a plan; see massing.h. Source: Freeman and Shapira, "Determining the minimum-area
// encasing rectangle for an arbitrary closed curve", 1975.
#include <algorithm>
#include <glm/geometric.hpp>

#include "core/geom/polygon/massing.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// A rectangle must be smaller by this share to replace an earlier one, so that rounding does not choose.
constexpr double clearly_smaller = 1 - 1e-9;
// Edges of the hull that are tried.
constexpr std::size_t most_directions = 256;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The convex hull, counter-clockwise, without points on straight edges (Andrew's monotone chain).
std::vector<dvec2> hull_of(std::vector<dvec2> points) {
  const auto before = [](const dvec2& a, const dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  std::vector<dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const dvec2& p : points) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull[hull.size() - 2]) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

PlanBox smallest_box(const Plan& plan) {
  if (plan.rings.empty() || plan.rings[0].empty()) return {};
  const std::vector<dvec2> hull = hull_of(plan.rings[0]);
  PlanBox best{plan.rings[0][0], {1, 0}, {0, 0}};
  double least = -1;
  const std::size_t step = (hull.size() + most_directions - 1) / most_directions;
  for (std::size_t i = 0; i < hull.size(); i += std::max<std::size_t>(step, 1)) {
    const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double length = glm::length(edge);
    if (!(length > 0)) continue;
    const dvec2 along = edge / length, across(-along.y, along.x);
    dvec2 low(glm::dot(hull[i], along), glm::dot(hull[i], across)), high = low;
    for (const dvec2& p : hull) {
      const dvec2 at(glm::dot(p, along), glm::dot(p, across));
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    const dvec2 half = (high - low) / 2.0, middle = (high + low) / 2.0;
    const double area = half.x * half.y;
    if (least >= 0 && area >= least * clearly_smaller) continue;
    least = area;
    best.middle = along * middle.x + across * middle.y;
    const bool is_turned = half.y > half.x * (1 + 1e-9);
    best.along = is_turned ? across : along;
    best.half = is_turned ? dvec2(half.y, half.x) : half;
  }
  return best;
}

}  // namespace seedmesh
