#pragma once
/// Lengths and turns of vectors in the plan.
#include <cmath>
#include <glm/glm.hpp>

#include "core/base/math.h"

namespace seedmesh::city {

inline double length_of(const glm::dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Returns a vector turned counter-clockwise.
inline glm::dvec2 rotated(const glm::dvec2& v, const math::SinCos& turn) {
  return {v.x * turn.cos - v.y * turn.sin, v.x * turn.sin + v.y * turn.cos};
}
inline glm::dvec2 rotated(const glm::dvec2& v, double degrees) {
  return rotated(v, math::sincos_degrees(degrees));
}

}  // namespace seedmesh::city
