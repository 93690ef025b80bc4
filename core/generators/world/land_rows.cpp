/// The formulas are those of land.cpp, in loops over positions that the compiler vectorises.
#include "core/generators/world/land_rows.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/wide.h"
#include "core/generators/world/land.h"

namespace seedmesh::world {
namespace {

using Row = std::vector<float>;

constexpr float scale = 1.4F;  ///< scale of noise()

/// A cell of a lattice and its four directions.
struct Cell {
  Cell(std::uint64_t key, double column, double row) {
    const auto whole = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)); };
    const std::uint64_t west = whole(column) * lattice::column_factor, beyond = west + lattice::column_factor;
    const std::uint64_t south = whole(row) * lattice::row_factor, north = south + lattice::row_factor;
    a = lattice::float_direction[lattice::number_of(key ^ west ^ south)];
    b = lattice::float_direction[lattice::number_of(key ^ beyond ^ south)];
    c = lattice::float_direction[lattice::number_of(key ^ west ^ north)];
    d = lattice::float_direction[lattice::number_of(key ^ beyond ^ north)];
  }
  const float *a, *b, *c, *d;
};

/// Positions of a row inside one cell: the fractions of the first and their steps.
struct Inside {
  float u, v, du, dv;
};

/// The directions at the corners of a cell, by value, so that a loop keeps them in registers.
struct Directions {
  explicit Directions(const Cell& cell)
      : ax(cell.a[0]),
        ay(cell.a[1]),
        bx(cell.b[0]),
        by(cell.b[1]),
        cx(cell.c[0]),
        cy(cell.c[1]),
        dx(cell.d[0]),
        dy(cell.d[1]) {}
  float ax, ay, bx, by, cx, cy, dx, dy;

  /// Noise at the fractions (u, v) of the cell.
  float at(float u, float v) const {
    const float s = u * u * u * (u * (u * 6 - 15) + 10), t = v * v * v * (v * (v * 6 - 15) + 10);
    const float sw = ax * u + ay * v, se = bx * (u - 1) + by * v;
    const float nw = cx * u + cy * (v - 1), ne = dx * (u - 1) + dy * (v - 1);
    const float south = sw + s * (se - sw), north = nw + s * (ne - nw);
    return south + t * (north - south);
  }
};

void add_inside(const Cell& cell, const Inside& at, float amplitude, std::size_t count, float* out) {
  const Directions directions(cell);
  for (std::size_t k = 0; k < count; ++k) {
    const auto n = static_cast<float>(static_cast<std::int32_t>(k));
    out[k] += amplitude * directions.at(at.u + n * at.du, at.v + n * at.dv);
  }
}

/// Adds noise where hardly two positions lie in one cell.
void add_singles(const RowOfPositions& row, std::uint64_t key, double by, float amplitude, Row& out) {
  for (std::size_t k = 0; k < row.count; ++k) {
    const double east = row.west + static_cast<double>(k) * row.spacing;
    const double x = (turn_cosine * east - turn_sine * row.north) * by,
                 y = (turn_sine * east + turn_cosine * row.north) * by;
    const double column = std::floor(x), line = std::floor(y);
    out[k] +=
        amplitude *
        Directions(Cell(key, column, line)).at(static_cast<float>(x - column), static_cast<float>(y - line));
  }
}

/// Adds an octave of noise with a wavelength of 1 / `by` metres.
void add_octave(const RowOfPositions& row, std::uint64_t key, double by, double amplitude, Row& out) {
  const double step_x = turn_cosine * row.spacing * by, step_y = turn_sine * row.spacing * by;
  if (step_x + step_y > 0.6) return add_singles(row, key, by, scale * static_cast<float>(amplitude), out);
  for (std::size_t k = 0; k < row.count;) {
    const double east = row.west + static_cast<double>(k) * row.spacing;
    const double x = (turn_cosine * east - turn_sine * row.north) * by,
                 y = (turn_sine * east + turn_cosine * row.north) * by;
    const double column = std::floor(x), line = std::floor(y);
    const double left = std::min((column + 1 - x) / step_x, (line + 1 - y) / step_y);
    const double most = static_cast<double>(row.count - k);
    const auto count = static_cast<std::size_t>(math::to_int64(std::clamp(std::ceil(left), 1.0, most)));
    add_inside(Cell(key, column, line),
               {static_cast<float>(x - column), static_cast<float>(y - line), static_cast<float>(step_x),
                static_cast<float>(step_y)},
               scale * static_cast<float>(amplitude), count, out.data() + k);
    k += count;
  }
}

/// Octaves that halve in wavelength and amplitude, within about -1 to 1.
template <std::size_t octaves>
void set_sum(const RowOfPositions& row, const std::array<std::uint64_t, octaves>& keys, double by, Row& out) {
  out.assign(row.count, 0);
  double total = 0, amplitude = 1;
  for (std::size_t k = 0; k < octaves; ++k, amplitude *= 0.5) total += amplitude;
  amplitude = 1.5 / total;
  for (const std::uint64_t key : keys) {
    add_octave(row, key, by, amplitude, out);
    by *= 2;
    amplitude *= 0.5;
  }
}

float smooth_step(float x, float low, float high) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// As in land.cpp, without branches.
float coast_height(float coast) {
  constexpr auto blend = static_cast<float>(coast_blend), fall = static_cast<float>(sea_fall),
                 bend = static_cast<float>(land_rise - sea_fall);
  const float from = std::clamp(coast + blend, 0.0F, 2 * blend), beyond = std::max(0.0F, coast - blend);
  return fall * coast + bend * (from * from / (4 * blend) + beyond);
}

float terraced(float height, float share) {
  constexpr auto step = static_cast<float>(terrace_step);
  const float level = std::floor(height / step), t = height / step - level;
  const float s = t * t * t * (t * (t * 6 - 15) + 10);
  return height * (1 - share) + step * (level + s) * share;
}

/// Adds mountain ranges to the heights, and sets the shares of their octaves.
void add_ranges(const World& world, const RowOfPositions& row, LandRow& land) {
  const WorldRelief& relief = world.params.relief;
  const auto k = static_cast<float>(0.02 + 0.35 * (1 - relief.ridges));
  double total = 0, amplitude = 1;
  for (std::size_t n = 0; n < range_octaves; ++n, amplitude *= range_fall) total += amplitude;
  auto by_height = static_cast<float>(1.6 * relief.mountains / total);
  Row noise, weight(row.count, 1);
  double by = 1 / range_wavelength;
  for (std::size_t n = 0; n < range_octaves; ++n, by *= 2) {
    noise.assign(row.count, 0);
    add_octave(row, world.noise.ranges[n], by, 1, noise);
    Row& ridge = land.ridges[n];
    ridge.resize(row.count);
    for (std::size_t i = 0; i < row.count; ++i) {
      const float crest = 1 + k - std::sqrt(noise[i] * noise[i] + k * k);
      const float part = crest * crest * weight[i];
      ridge[i] = weight[i] * land.ruggedness[i];
      land.height[i] += part * land.ruggedness[i] * by_height;
      weight[i] = std::min(part, 1.0F);
    }
    by_height *= static_cast<float>(range_fall);
  }
}

}  // namespace

SEEDMESH_WIDE void land_of_row(const World& world, const RowOfPositions& row, LandRow& land) {
  const WorldRelief& relief = world.params.relief;
  Row on_land(row.count), hills;
  set_sum(row, world.noise.coast, 1 / relief.continents, land.coast);
  set_sum(row, world.noise.belts, 1 / belt_wavelength, land.ruggedness);
  land.height.resize(row.count);
  bool is_rugged = false;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float coast = land.coast[i] += static_cast<float>(world.land_bias);
    on_land[i] = smooth_step(coast, -0.04F, 0.3F);
    const float rugged = smooth_step(land.ruggedness[i], -0.25F, 0.55F) * on_land[i];
    land.ruggedness[i] = rugged;
    is_rugged |= rugged > 0;
    land.height[i] = coast_height(coast);
  }
  for (Row& ridge : land.ridges) ridge.assign(row.count, 0);
  if (relief.mountains > 0 && is_rugged) add_ranges(world, row, land);
  if (relief.hills > 0) {
    set_sum(row, world.noise.hills, 1 / hill_wavelength, hills);
    const auto high = static_cast<float>(relief.hills);
    for (std::size_t i = 0; i < row.count; ++i)
      land.height[i] += (hills[i] + 0.35F) * (on_land[i] * 0.85F + 0.15F) * high;
  }
  const auto terraces = static_cast<float>(relief.terraces), zero = static_cast<float>(relief.sea_level);
  for (float& height : land.height) height = (terraces > 0 ? terraced(height, terraces) : height) + zero;
}

}  // namespace seedmesh::world
