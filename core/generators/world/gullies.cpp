#include "core/generators/world/gullies.h"

#include <cmath>

#include "core/base/quick_float.h"

namespace seedmesh::world {
namespace {

constexpr float turn = 6.28318531F;

/// Stripes in the direction (x, y), about -1 to 1. Cells are as wide as one and a half stripes.
float stripes(std::uint64_t key, double east, double north, float x, float y) {
  constexpr float cell = 1.5F;
  const double column = std::floor(east / cell), row = std::floor(north / cell);
  const auto u = static_cast<float>(east / cell - column), v = static_cast<float>(north / cell - row);
  const auto i = static_cast<std::uint64_t>(static_cast<std::int64_t>(column));
  const auto j = static_cast<std::uint64_t>(static_cast<std::int64_t>(row));
  float sum = 0, total = 1e-6F;
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      std::uint64_t hash = key ^ ((i + static_cast<std::uint64_t>(di)) * 0x9E3779B97F4A7C15U) ^
                           ((j + static_cast<std::uint64_t>(dj)) * 0xC2B2AE3D27D4EB4FU);
      hash ^= hash >> 32U;
      hash *= 0xD6E8FEB86659FD93U;
      const float px = u - static_cast<float>(di) - static_cast<float>(hash >> 44U) * 0x1p-20F;
      const float py = v - static_cast<float>(dj) - static_cast<float>((hash >> 24U) & 0xFFFFFU) * 0x1p-20F;
      const float square = px * px + py * py;
      const float left = square < 1 ? 1 - square : 0;
      const float weight = left * left;
      sum += weight * math::quick_sincos(turn * cell * (px * x + py * y)).cos;
      total += weight;
    }
  }
  return sum / total;
}

}  // namespace

double gullies_at(std::uint64_t key, const Slope& slope, double east, double north) {
  const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
  const double strength = smooth_step(steepness, 0.04, 0.45);
  if (strength <= 0) return 0;
  // across the slope
  const auto x = static_cast<float>(-slope.north / steepness), y = static_cast<float>(slope.east / steepness);
  double sum = 0, wavelength = widest_gully;
  for (int n = 0; n < gully_octaves; ++n, wavelength *= gully_fall) {
    const float s =
        stripes(key_at(key, static_cast<std::uint64_t>(n)), east / wavelength, north / wavelength, x, y);
    sum += (static_cast<double>(s) - 0.3) * gully_depth * wavelength;
  }
  return sum * strength;
}

}  // namespace seedmesh::world
