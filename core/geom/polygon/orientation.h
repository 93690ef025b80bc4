#pragma once
/// Exact predicates for points of the plane.
#include <glm/vec2.hpp>

namespace seedmesh {

/// Returns twice the signed area of the triangle a, b, c, with rounding errors; positive for counter-clockwise order.
inline double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns 1 if a, b, c turn counter-clockwise, -1 if they turn clockwise, 0 if they lie on one line. The result
/// is exact for finite coordinates between 1e-140 and 1e140 in magnitude, and for 0. Cost: about 3 ns; about 100
/// ns for points that are almost on one line. Source: Shewchuk, "Adaptive precision floating-point arithmetic and
/// fast robust geometric predicates", 1997.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

}  // namespace seedmesh
