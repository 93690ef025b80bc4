#include "core/generators/world/valley.h"

#include <algorithm>

namespace seedmesh::world {

Slope valley_side(double away, double half_width, double ruggedness, double most) {
  const double flat = 40 + 8 * half_width, slope = 0.16 + 0.36 * ruggedness;
  const double beyond = std::max(0.0, away - flat);
  const double rise = 1 + 0.02 * away + slope * beyond;
  const double t = away * (1 / valley_reach), left = 1 - t * t;
  if (left <= 1e-6 || rise >= most) return {1e12, 0, 0};
  return {rise / left, 0.02 + slope * smooth_step(beyond, 0, 90), 0};
}

double valley_blend(double from_bank) {
  constexpr double least = 2, by = 0.04, most = 24;
  return std::min(most, least + by * from_bank);
}

}  // namespace seedmesh::world
