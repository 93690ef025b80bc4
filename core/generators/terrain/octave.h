#pragma once
/// One octave of gradient noise in the plane.
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh::terrain {

constexpr std::size_t directions = 64;
// The greatest value of plane gradient noise with unit gradients, which scales it to -1 .. 1.
constexpr float plane_scale = 1.41421356F;

struct Gradient {
  float x = 0, z = 0;
};

inline const std::array<Gradient, directions>& gradients() {
  static const auto all = [] {
    std::array<Gradient, directions> table;
    for (std::size_t i = 0; i < directions; ++i) {
      const math::SinCos turn = math::sincos(2 * math::pi * (static_cast<double>(i) + 0.5) / directions);
      table[i] = {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
    }
    return table;
  }();
  return all;
}

constexpr float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

inline std::int64_t folded(std::int64_t i, std::int64_t period) {
  if (period == 0) return i;
  const std::int64_t rest = i % period;
  return rest < 0 ? rest + period : rest;
}

/// One octave of noise.
struct Octave {
  std::uint64_t key = 0;
  double frequency = 1;  ///< lattice cells per metre
  std::int64_t period = 0;

  std::uint64_t row_key(std::int64_t z) const {
    return key_at(key, static_cast<std::uint64_t>(folded(z, period)));
  }
  Gradient at(std::uint64_t row, std::int64_t x) const {
    const std::uint64_t bits = mix(row + 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(folded(x, period)));
    return gradients()[bits % directions];
  }
};

/// One octave for points that follow one another closely: the gradients of the last cell are kept.
class OctavePath {
 public:
  explicit OctavePath(const Octave& octave) : octave_(octave) {}

  float value(double x, double z) {
    const double left = std::floor(x), top = std::floor(z);
    if (left != left_ || top != top_) take_cell(left, top);
    const auto fx = static_cast<float>(x - left), fz = static_cast<float>(z - top);
    const auto dot = [](Gradient g, float dx, float dz) { return g.x * dx + g.z * dz; };
    const float nw = dot(corners_[0], fx, fz), ne = dot(corners_[1], fx - 1, fz);
    const float sw = dot(corners_[2], fx, fz - 1), se = dot(corners_[3], fx - 1, fz - 1);
    const float u = fade(fx), v = fade(fz);
    const float n = nw + u * (ne - nw), s = sw + u * (se - sw);
    return (n + v * (s - n)) * plane_scale;
  }

  double frequency() const { return octave_.frequency; }

 private:
  void take_cell(double left, double top) {
    const std::int64_t i = math::to_int64(left), j = math::to_int64(top);
    const std::uint64_t north = octave_.row_key(j), south = octave_.row_key(j + 1);
    corners_ = {octave_.at(north, i), octave_.at(north, i + 1), octave_.at(south, i),
                octave_.at(south, i + 1)};
    left_ = left;
    top_ = top;
  }

  Octave octave_;
  double left_ = 0.5, top_ = 0.5;  ///< corner of the cell; no cell begins at a half
  std::array<Gradient, 4> corners_;
};

}  // namespace seedmesh::terrain
