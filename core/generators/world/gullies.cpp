#include "core/generators/world/gullies.h"

#include <cmath>
#include <cstddef>

#include "core/base/quick_float.h"
#include "core/base/wide.h"

namespace seedmesh::world {
namespace {

constexpr float cell = 1.5F;  ///< sides of cells by the distance of stripes
/// Points of cells are away from their borders, so that a point is within the reach of each position: without one the
/// height would fall to that of no gullies within centimetres. All points in reach are in the nine cells.
constexpr float least_jitter = 0.2F, jitter = 0.6F, reach_square = 1.44F;
constexpr std::size_t cells = 9, lanes = 12;  ///< cells around a position; a multiple of four for vectors

/// The cosine of a number of turns; the error is below 2e-5.
inline float cosine_of_turns(float turns) {
  const float r = turns - math::nearest(turns), z = r * r;
  const float sine =
      r * (3.14159265F + z * (-5.16771278F + z * (2.55016404F + z * (-0.59926453F + z * 0.08214589F))));
  return 1 - 2 * sine * sine;
}

/// Sums of lanes in a fixed order.
inline float sum_of(const std::array<float, lanes>& v) {
  std::array<float, 4> s{};
  for (std::size_t k = 0; k < 4; ++k) s[k] = v[k] + v[k + 4] + v[k + 8];
  return (s[0] + s[1]) + (s[2] + s[3]);
}

/// Stripes in the direction (x, y), about -1 to 1.
float stripes(std::uint64_t key, double east, double north, float x, float y) {
  const double across = east / static_cast<double>(cell), up = north / static_cast<double>(cell);
  const double column = std::floor(across), row = std::floor(up);
  const auto i = static_cast<std::uint64_t>(static_cast<std::int64_t>(column)) * lattice::column_factor;
  const auto j = static_cast<std::uint64_t>(static_cast<std::int64_t>(row)) * lattice::row_factor;
  const auto u = static_cast<float>(across - column), v = static_cast<float>(up - row);
  alignas(16) std::array<std::int32_t, lanes> jitter_x{}, jitter_y{};
  const std::uint64_t columns[3] = {i - lattice::column_factor, i, i + lattice::column_factor};
  const std::uint64_t rows[3] = {key ^ (j - lattice::row_factor), key ^ j, key ^ (j + lattice::row_factor)};
  for (std::size_t k = 0; k < cells; ++k) {
    std::uint64_t hash = rows[k / 3] ^ columns[k % 3];
    hash ^= hash >> 32U;
    hash *= 0xD6E8FEB86659FD93U;
    jitter_x[k] = static_cast<std::int32_t>(hash >> 44U);
    jitter_y[k] = static_cast<std::int32_t>((hash >> 24U) & 0xFFFFFU);
  }
  // the last three lanes are too far away to count
  alignas(16) static constexpr std::array<float, lanes> first_x{-1, 0, 1, -1, 0, 1, -1, 0, 1, 9, 9, 9};
  alignas(16) static constexpr std::array<float, lanes> first_y{-1, -1, -1, 0, 0, 0, 1, 1, 1, 9, 9, 9};
  alignas(16) std::array<float, lanes> parts, weights;
  for (std::size_t k = 0; k < lanes; ++k) {
    const float px = u - first_x[k] - (least_jitter + static_cast<float>(jitter_x[k]) * (jitter * 0x1p-20F));
    const float py = v - first_y[k] - (least_jitter + static_cast<float>(jitter_y[k]) * (jitter * 0x1p-20F));
    const float square = px * px + py * py;
    const float left = square < reach_square ? 1 - square * (1 / reach_square) : 0;
    const float weight = left * left;
    parts[k] = weight * cosine_of_turns(cell * (px * x + py * y));
    weights[k] = weight;
  }
  return sum_of(parts) / (sum_of(weights) + 1e-6F);
}

}  // namespace

SEEDMESH_WIDE double gullies_at(const std::array<std::uint64_t, gully_octaves>& keys, const Slope& slope,
                                double east, double north) {
  const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
  const double strength = smooth_step(steepness, 0.04, 0.45);
  if (strength <= 0) return 0;
  // across the slope
  const auto x = static_cast<float>(-slope.north / steepness), y = static_cast<float>(slope.east / steepness);
  double sum = 0, wavelength = widest_gully;
  for (const std::uint64_t key : keys) {
    const float s = stripes(key, east / wavelength, north / wavelength, x, y);
    sum += (static_cast<double>(s) - 0.3) * gully_depth * wavelength;
    wavelength *= gully_fall;
  }
  return sum * strength;
}

}  // namespace seedmesh::world
