#pragma once
/// Four vectors side by side, so that compilers turn loops over them into vector instructions. Every lane is
/// reckoned exactly as glm and math.h reckon one vector, so that the bits are the same either way.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

namespace seedmesh {

struct Four {
  static constexpr std::size_t size = 4;
  alignas(16) float x[size], y[size], z[size];

  Four() = default;
  /// The first `count` (1..4) of `from`; the last fills the rest.
  Four(const glm::vec3* from, std::size_t count) {
    for (std::size_t k = 0; k < size; ++k) {
      const glm::vec3& v = from[std::min(k, count - 1)];
      x[k] = v.x;
      y[k] = v.y;
      z[k] = v.z;
    }
  }
  glm::vec3 operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
};

/// math::quick_unit of each; false: one is too short or too long for it, and `v` is as it was.
inline bool to_units(Four& v) {
  alignas(16) float square[Four::size], length[Four::size];
  int good = 0;
  for (std::size_t k = 0; k < Four::size; ++k) {
    square[k] = v.x[k] * v.x[k] + v.y[k] * v.y[k] + v.z[k] * v.z[k];
    length[k] = std::sqrt(square[k]);
  }
  for (std::size_t k = 0; k < Four::size; ++k) good += square[k] > 1e-30F && square[k] < 1e30F ? 1 : 0;
  if (good != static_cast<int>(Four::size)) return false;
  for (std::size_t k = 0; k < Four::size; ++k) {
    v.x[k] /= length[k];
    v.y[k] /= length[k];
    v.z[k] /= length[k];
  }
  return true;
}

}  // namespace seedmesh
