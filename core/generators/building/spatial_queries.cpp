#include "core/generators/building/spatial_queries.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

constexpr double skin = 1e-5;  ///< metres: how thick a flat box is taken on either side

double share_of(const glm::dvec3& low, const glm::dvec3& high, Solid solid) {
  for (int axis = 0; axis < 3 && !solid.faces.empty(); ++axis) {
    solid = clipped(solid, axis, high[axis], 1);
    solid = clipped(solid, axis, low[axis], -1);
  }
  const glm::dvec3 size = high - low;
  return solid.faces.empty() ? 0 : volume_of(solid, glm::dvec3(1)) / (size.x * size.y * size.z);
}

}  // namespace

double share_inside(const Scope& box, const Solid& solid, const Scope& other) {
  // In the frame of the box; the unit is its size, or the thickness of the layer of a flat box.
  glm::dvec3 unit = box.size;
  int flat = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (unit[axis] > 0) continue;
    unit[axis] = skin;
    flat = axis;
  }
  Solid own = solid;
  const glm::dmat3 back = glm::transpose(box.axes);
  for (glm::dvec3& p : own.points)
    p = back * (other.origin + other.axes * (p * other.size) - box.origin) / unit;
  if (flat < 0) return std::clamp(share_of(glm::dvec3(0), glm::dvec3(1), std::move(own)), 0.0, 1.0);
  double most = 0;
  for (const double side : {-2.0, 1.0}) {
    glm::dvec3 low(0), high(1);
    low[flat] = side;
    high[flat] = side + 1;
    most = std::max(most, share_of(low, high, own));
  }
  return std::clamp(most, 0.0, 1.0);
}

bool is_line_blocked(const glm::dvec3& from, const glm::dvec3& to, const Solid* solid, const Scope& other,
                     double skin_here) {
  const double length = glm::length(to - from);
  if (!(length > 2 * skin_here)) return false;
  const glm::dmat3 back = glm::transpose(other.axes);
  const glm::dvec3 a = back * (from - other.origin), along = back * ((to - from) / length);
  double enter = skin_here, leave = length - skin_here;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = skin_here, high = other.size[axis] - skin_here;
    if (std::abs(along[axis]) < 1e-12) {
      if (a[axis] <= low || a[axis] >= high) return false;
      continue;
    }
    const double p = (low - a[axis]) / along[axis], q = (high - a[axis]) / along[axis];
    enter = std::max(enter, std::min(p, q));
    leave = std::min(leave, std::max(p, q));
  }
  if (leave <= enter) return false;
  if (solid == nullptr) return true;
  // In metres of the scope. The line is blocked if it meets the surface or begins inside.
  Solid own = *solid;
  for (glm::dvec3& p : own.points) p *= other.size;
  int crossings_behind = 0;
  for (const Face& face : own.faces) {
    const glm::dvec3 normal = area_vector(own, face, glm::dvec3(1));
    const double slope = glm::dot(normal, along);
    if (slope == 0) continue;
    const glm::dvec3 base = own.points[own.corners[own.loops[face.first_loop].first]];
    const double t = glm::dot(normal, base - a) / slope;
    if (t < skin_here || !is_inside(own, loops_of(own, face), normal, a + t * along)) continue;
    if (t < length - skin_here) return true;
    ++crossings_behind;
  }
  return crossings_behind % 2 == 1;
}

glm::dvec3 nearest_point(const Scope& box, const glm::dvec3& to) {
  const glm::dvec3 local = glm::transpose(box.axes) * (to - box.origin);
  return box.origin + box.axes * glm::clamp(local, glm::dvec3(0), box.size);
}

}  // namespace seedmesh::building
