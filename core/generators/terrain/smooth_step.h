#pragma once
/// A smooth step.
#include <algorithm>

namespace seedmesh::terrain {

/// Returns 0 up to `from`, 1 from `to` on, and a cubic with level ends between.
inline float smooth_step(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace seedmesh::terrain
