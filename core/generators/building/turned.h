#pragma once
/// Turns about an axis of a scope or of a picture.
#include <glm/glm.hpp>

#include "core/base/math.h"

namespace seedmesh::building {

/// The rotation about `axis` (0 x, 1 y, 2 z) by degrees, anticlockwise as seen from its tip.
inline glm::dmat3 turned(int axis, double degrees) {
  const math::SinCos a = math::sincos_degrees(degrees);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  glm::dmat3 m(1);
  m[u][u] = a.cos;
  m[u][v] = a.sin;
  m[v][u] = -a.sin;
  m[v][v] = a.cos;
  return m;
}

}  // namespace seedmesh::building
