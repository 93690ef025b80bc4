#include "core/geom/mesh/solid.h"

#include <algorithm>
#include <cmath>

namespace seedmesh {
namespace {

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

/// The nearer of two candidates.
glm::dvec3 nearer(const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 by_a = a - to, by_b = b - to;
  return glm::dot(by_b, by_b) < glm::dot(by_a, by_a) ? b : a;
}

/// The unit direction of (x, z), or +X where both are 0.
glm::dvec2 level_direction(const glm::dvec3& q) {
  const double length = std::sqrt(q.x * q.x + q.z * q.z);
  return length > 0 ? glm::dvec2{q.x / length, q.z / length} : glm::dvec2{1, 0};
}

/// True where q is inside the shape of half extent 1 about the origin.
bool is_inside(SolidShape shape, const glm::dvec3& q) {
  const double level = q.x * q.x + q.z * q.z;
  switch (shape) {
    case SolidShape::sphere:
      return level + q.y * q.y <= 1;
    case SolidShape::cylinder:
      return level <= 1 && std::abs(q.y) <= 1;
    case SolidShape::cone:
      return std::abs(q.y) <= 1 && std::sqrt(level) <= 0.5 * (1 - q.y);
    case SolidShape::box:
    case SolidShape::mesh:
      break;
  }
  return std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) <= 1;
}

glm::dvec3 nearest_of_box(const glm::dvec3& q, const glm::dvec3& half) {
  if (!is_inside(SolidShape::box, q)) return glm::clamp(q, glm::dvec3(-1), glm::dvec3(1));
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (half[i] * (1 - std::abs(q[i])) < half[axis] * (1 - std::abs(q[axis]))) axis = i;
  }
  glm::dvec3 nearest = q;
  nearest[axis] = q[axis] < 0 ? -1 : 1;
  return nearest;
}

glm::dvec3 nearest_of_cylinder(const glm::dvec3& q, const glm::dvec3& half) {
  const glm::dvec2 out = level_direction(q);
  const double level = std::min(1.0, std::sqrt(q.x * q.x + q.z * q.z));
  const glm::dvec3 side{out.x, std::clamp(q.y, -1.0, 1.0), out.y};
  const glm::dvec3 lid{out.x * level, q.y < 0 ? -1.0 : 1.0, out.y * level};
  return nearer(q * half, side * half, lid * half) / half;
}

/// In the half plane through the axis and the point, the side of the cone is a line segment.
glm::dvec3 nearest_of_cone(const glm::dvec3& q, const glm::dvec3& half) {
  const glm::dvec2 out = level_direction(q);
  const double level = std::sqrt(q.x * q.x + q.z * q.z);
  const double reach = std::sqrt(half.x * half.x * out.x * out.x + half.z * half.z * out.y * out.y);
  const glm::dvec2 foot{reach, -half.y}, flank{-reach, 2 * half.y};
  const glm::dvec2 from_foot = glm::dvec2{level * reach, q.y * half.y} - foot;
  const double share = std::clamp(glm::dot(from_foot, flank) / glm::dot(flank, flank), 0.0, 1.0);
  const glm::dvec3 side{out.x * (1 - share), 2 * share - 1, out.y * (1 - share)};
  const double floor_level = std::min(level, 1.0);
  const glm::dvec3 floor{out.x * floor_level, -1, out.y * floor_level};
  return nearer(q * half, side * half, floor * half) / half;
}

glm::dvec3 middle_of(const Solid& solid) { return solid.position + glm::dvec3{0, 0.5 * solid.size.y, 0}; }

/// True inside; on the surface, where the distance is 0, it may be either.
bool encloses(const Solid& solid, const glm::dvec3& point) {
  if (solid.shape == SolidShape::mesh) return solid.mesh->contains(point);
  return is_inside(solid.shape, (point - middle_of(solid)) / (0.5 * solid.size));
}

double surface_distance(const Solid& solid, const glm::dvec3& point) {
  return length_of(nearest_on_surface(solid, point) - point);
}

}  // namespace

glm::dvec3 nearest_on_surface(const Solid& solid, const glm::dvec3& point) {
  if (solid.shape == SolidShape::mesh) return solid.mesh->nearest(point).point;
  const glm::dvec3 half = 0.5 * solid.size;
  const glm::dvec3 middle = middle_of(solid);
  const glm::dvec3 q = (point - middle) / half;
  glm::dvec3 on{0};
  switch (solid.shape) {
    case SolidShape::sphere: {
      const double length = length_of(q);
      on = length > 0 ? q / length : glm::dvec3{0, 1, 0};
      break;
    }
    case SolidShape::cylinder:
      on = nearest_of_cylinder(q, half);
      break;
    case SolidShape::cone:
      on = nearest_of_cone(q, half);
      break;
    case SolidShape::box:
    case SolidShape::mesh:
      on = nearest_of_box(q, half);
      break;
  }
  return middle + on * half;
}

SurfacePoint surface_near(const Solid& solid, const glm::dvec3& point) {
  const glm::dvec3 nearest = nearest_on_surface(solid, point);
  const double distance = length_of(nearest - point);
  return {nearest, encloses(solid, point) ? -distance : distance};
}

bool lies_inside(const Solid& solid, const glm::dvec3& point) {
  return encloses(solid, point) && surface_distance(solid, point) != 0;
}

bool lies_outside(const Solid& solid, const glm::dvec3& point) {
  return !encloses(solid, point) && surface_distance(solid, point) != 0;
}

}  // namespace seedmesh
