#pragma once
/// Rotations about coordinate axes.
#include <glm/glm.hpp>

#include "core/base/math.h"

namespace seedmesh::building {

/// Returns the rotation about `axis` (0 x, 1 y, 2 z) by an angle in degrees, counter-clockwise seen from the
/// positive end of the axis.
inline glm::dmat3 rotation_about(int axis, double degrees) {
  const math::SinCos a = math::sincos_degrees(degrees);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  glm::dmat3 m(1);
  m[u][u] = a.cos;
  m[u][v] = a.sin;
  m[v][u] = -a.sin;
  m[v][v] = a.cos;
  return m;
}

/// Returns the rotations about x, then y, then z, all about fixed axes.
inline glm::dmat3 rotation_xyz(const glm::dvec3& degrees) {
  glm::dmat3 m(1);
  for (int axis = 0; axis < 3; ++axis) {
    if (degrees[axis] != 0) m = rotation_about(axis, degrees[axis]) * m;
  }
  return m;
}

}  // namespace seedmesh::building
