#pragma once
/// Several octaves of gradient noise at one position, in single precision and in loops that the compiler vectorises.
/// Cells and fractions are found in doubles, so a position gives the same bits in every world that contains it.
#include <array>
#include <cmath>
#include <cstddef>

#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Computes up to `lanes` octaves; `lanes` is a multiple of four. Call add() for each octave, then compute() or
/// compute_values() once. Then read the octaves by their index in the order of add().
template <std::size_t lanes>
class Octaves {
 public:
  /// Adds the octave that octave() of noise.h computes, with a wavelength of 1 / `by` metres.
  void add(std::uint64_t key, double east, double north, double by) {
    const double x = (turn_cosine * east - turn_sine * north) * by,
                 y = (turn_sine * east + turn_cosine * north) * by;
    const double column = std::floor(x), row = std::floor(y);
    const std::uint64_t west = key ^ (whole(column) * lattice::column_factor),
                        beyond = key ^ (whole(column) * lattice::column_factor + lattice::column_factor);
    const std::uint64_t south = whole(row) * lattice::row_factor, north_row = south + lattice::row_factor;
    u_[count_] = static_cast<float>(x - column);
    v_[count_] = static_cast<float>(y - row);
    by_[count_] = static_cast<float>(by);
    const float* const a = direction[lattice::number_of(west ^ south)];
    const float* const b = direction[lattice::number_of(beyond ^ south)];
    const float* const c = direction[lattice::number_of(west ^ north_row)];
    const float* const d = direction[lattice::number_of(beyond ^ north_row)];
    ax_[count_] = a[0];
    ay_[count_] = a[1];
    bx_[count_] = b[0];
    by_y_[count_] = b[1];
    cx_[count_] = c[0];
    cy_[count_] = c[1];
    dx_[count_] = d[0];
    dy_[count_] = d[1];
    ++count_;
  }

  void compute_values() {
    for (std::size_t k = 0; k < lanes; ++k) {
      const Corners n = corners(k);
      const float s = fade(u_[k]), t = fade(v_[k]);
      values_[k] = scale * (n.a + s * (n.b - n.a) + t * (n.c - n.a) + s * t * (n.a - n.b - n.c + n.d));
    }
  }

  void compute() {
    for (std::size_t k = 0; k < lanes; ++k) {
      const Corners n = corners(k);
      const float u = u_[k], v = v_[k], s = fade(u), t = fade(v);
      const float ds = 30 * u * u * (u * (u - 2) + 1), dt = 30 * v * v * (v * (v - 2) + 1);
      const float cross = n.a - n.b - n.c + n.d;
      const float x = ax_[k] + s * (bx_[k] - ax_[k]) + t * (cx_[k] - ax_[k]) +
                      s * t * (ax_[k] - bx_[k] - cx_[k] + dx_[k]) + ds * (n.b - n.a + t * cross);
      const float y = ay_[k] + s * (by_y_[k] - ay_[k]) + t * (cy_[k] - ay_[k]) +
                      s * t * (ay_[k] - by_y_[k] - cy_[k] + dy_[k]) + dt * (n.c - n.a + s * cross);
      values_[k] = scale * (n.a + s * (n.b - n.a) + t * (n.c - n.a) + s * t * cross);
      east_[k] = scale * by_[k] * (static_cast<float>(turn_cosine) * x + static_cast<float>(turn_sine) * y);
      north_[k] = scale * by_[k] * (static_cast<float>(turn_cosine) * y - static_cast<float>(turn_sine) * x);
    }
  }

  double value(std::size_t k) const { return static_cast<double>(values_[k]); }
  /// Returns the value with its derivatives by east and north, per metre.
  Slope slope(std::size_t k) const {
    return {value(k), static_cast<double>(east_[k]), static_cast<double>(north_[k])};
  }

 private:
  using Lanes = std::array<float, lanes>;
  static constexpr float scale = 1.4F;
  static constexpr const auto& direction = lattice::float_direction;

  /// The products at the four corners of the cell.
  struct Corners {
    float a, b, c, d;
  };
  Corners corners(std::size_t k) const {
    const float u = u_[k], v = v_[k];
    return {ax_[k] * u + ay_[k] * v, bx_[k] * (u - 1) + by_y_[k] * v, cx_[k] * u + cy_[k] * (v - 1),
            dx_[k] * (u - 1) + dy_[k] * (v - 1)};
  }
  static float fade(float u) { return u * u * u * (u * (u * 6 - 15) + 10); }
  static std::uint64_t whole(double x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)); }

  alignas(16) Lanes u_{}, v_{}, by_{}, ax_{}, ay_{}, bx_{}, by_y_{}, cx_{}, cy_{}, dx_{}, dy_{};
  alignas(16) Lanes values_, east_, north_;
  std::size_t count_ = 0;
};

}  // namespace seedmesh::world
