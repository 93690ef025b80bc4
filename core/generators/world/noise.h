#pragma once
/// Gradient noise with its derivative (Perlin 2002, "Improving noise") on an integer lattice. Positions are
/// absolute metres of the plane in doubles, so a position gives the same bits in every world that contains it.
#include <cmath>
#include <cstdint>

#include "core/base/rng.h"

namespace seedmesh::world {

/// A value and its derivatives by east and north.
struct Slope {
  double value = 0, east = 0, north = 0;
};

inline Slope operator+(const Slope& a, const Slope& b) {
  return {a.value + b.value, a.east + b.east, a.north + b.north};
}
inline Slope operator-(const Slope& a, const Slope& b) {
  return {a.value - b.value, a.east - b.east, a.north - b.north};
}
inline Slope operator*(const Slope& a, double by) { return {a.value * by, a.east * by, a.north * by}; }
inline Slope operator*(const Slope& a, const Slope& b) {
  return {a.value * b.value, a.east * b.value + a.value * b.east, a.north * b.value + a.value * b.north};
}

/// Applies the chain rule for a function of one variable.
inline Slope applied(const Slope& a, double value, double derivative) {
  return {value, a.east * derivative, a.north * derivative};
}

/// Returns 0 below `low` and 1 above `high`, with a continuous derivative.
inline Slope smooth_step(const Slope& a, double low, double high) {
  const double t = (a.value - low) / (high - low);
  if (t <= 0) return {0, 0, 0};
  if (t >= 1) return {1, 0, 0};
  return applied(a, t * t * (3 - 2 * t), 6 * t * (1 - t) / (high - low));
}
/// Like smooth_step() above, for a number without a derivative.
inline double smooth_step(double x, double low, double high) {
  return smooth_step(Slope{x, 0, 0}, low, high).value;
}

/// Returns the key of a lattice cell.
inline std::uint64_t cell_key(std::uint64_t key, std::int64_t x, std::int64_t y) {
  return mix(key + static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U +
             static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU);
}

namespace lattice {

/// Sixteen directions: cosines and sines of multiples of 22.5 degrees, turned by 9 degrees.
constexpr double direction[16][2] = {
    {0.98768834059513777, 0.15643446504023087},   {0.85264016435409218, 0.52249856471594891},
    {0.58778525229247314, 0.80901699437494745},   {0.23344536385590553, 0.97236992039767656},
    {-0.15643446504023087, 0.98768834059513777},  {-0.52249856471594891, 0.85264016435409218},
    {-0.80901699437494745, 0.58778525229247314},  {-0.97236992039767656, 0.23344536385590553},
    {-0.98768834059513777, -0.15643446504023087}, {-0.85264016435409218, -0.52249856471594891},
    {-0.58778525229247314, -0.80901699437494745}, {-0.23344536385590553, -0.97236992039767656},
    {0.15643446504023087, -0.98768834059513777},  {0.52249856471594891, -0.85264016435409218},
    {0.80901699437494745, -0.58778525229247314},  {0.97236992039767656, -0.23344536385590553}};
/// The same in single precision.
constexpr auto float_direction_of() {
  struct Table {
    float of[16][2];
  } table{};
  for (int k = 0; k < 16; ++k) {
    for (int axis = 0; axis < 2; ++axis) table.of[k][axis] = static_cast<float>(direction[k][axis]);
  }
  return table;
}
inline constexpr auto float_directions = float_direction_of();
inline constexpr const auto& float_direction = float_directions.of;

constexpr std::uint64_t column_factor = 0x9E3779B97F4A7C15U, row_factor = 0xC2B2AE3D27D4EB4FU;

/// Returns the number of a direction, 0 to 15. `hash` is the exclusive or of a key, a column and a row, as in
/// direction_of().
inline std::size_t number_of(std::uint64_t hash) {
  hash ^= hash >> 32U;
  hash *= 0xD6E8FEB86659FD93U;
  return hash >> 60U;
}

/// Returns the unit vector of a lattice corner.
inline const double* direction_of(std::uint64_t key, std::uint64_t x, std::uint64_t y) {
  return direction[number_of(key ^ (x * column_factor) ^ (y * row_factor))];
}

}  // namespace lattice

/// Returns a value from about -1 to 1, with a mean of 0, and its derivatives by x and y.
inline Slope noise(std::uint64_t key, double x, double y) {
  const double column = std::floor(x), row = std::floor(y);
  const double u = x - column, v = y - row;
  const auto i = static_cast<std::uint64_t>(static_cast<std::int64_t>(column));
  const auto j = static_cast<std::uint64_t>(static_cast<std::int64_t>(row));
  const double* a = lattice::direction_of(key, i, j);
  const double* b = lattice::direction_of(key, i + 1, j);
  const double* c = lattice::direction_of(key, i, j + 1);
  const double* d = lattice::direction_of(key, i + 1, j + 1);
  const double va = a[0] * u + a[1] * v, vb = b[0] * (u - 1) + b[1] * v;
  const double vc = c[0] * u + c[1] * (v - 1), vd = d[0] * (u - 1) + d[1] * (v - 1);
  const double s = u * u * u * (u * (u * 6 - 15) + 10), t = v * v * v * (v * (v * 6 - 15) + 10);
  const double ds = 30 * u * u * (u * (u - 2) + 1), dt = 30 * v * v * (v * (v - 2) + 1);
  const double cross = va - vb - vc + vd;
  const double east = a[0] + s * (b[0] - a[0]) + t * (c[0] - a[0]) + s * t * (a[0] - b[0] - c[0] + d[0]) +
                      ds * (vb - va + t * cross);
  const double north = a[1] + s * (b[1] - a[1]) + t * (c[1] - a[1]) + s * t * (a[1] - b[1] - c[1] + d[1]) +
                       dt * (vc - va + s * cross);
  constexpr double scale = 1.4;
  return {scale * (va + s * (vb - va) + t * (vc - va) + s * t * cross), scale * east, scale * north};
}

/// Cosine and sine of the angle by which the lattices of octaves are turned.
constexpr double turn_cosine = 0.8, turn_sine = 0.6;

/// Returns noise of a wavelength in metres. Its lattice is turned by a fixed angle.
inline Slope octave(std::uint64_t key, double east, double north, double wavelength) {
  constexpr double c = turn_cosine, s = turn_sine;
  const double by = 1 / wavelength;
  const Slope n = noise(key, (c * east - s * north) * by, (s * east + c * north) * by);
  return {n.value, (c * n.east + s * n.north) * by, (c * n.north - s * n.east) * by};
}

}  // namespace seedmesh::world
