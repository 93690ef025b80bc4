#pragma once
/// How stems bend from one segment to the next, those of many stems at once. About 5 ns a bend.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/generators/tree/frame_columns.h"
#include "core/generators/tree/weber_penn_shape.h"

namespace seedmesh::tree {

/// The inverse cosine, within 3e-8: what it turns by a stem is a share of it. After M. Abramowitz and I.
/// Stegun, Handbook of Mathematical Functions, 1964, 4.4.46.
inline double rough_acos(double x) {
  const double a = std::abs(x);
  const double angle =
      std::sqrt(1 - a) *
      (1.5707963050 +
       a * (-0.2145988016 +
            a * (0.0889789874 +
                 a * (-0.0501743046 +
                      a * (0.0308918810 + a * (-0.0170881256 + a * (0.0066700901 + a * -0.0012624911)))))));
  return x < 0 ? math::pi - angle : angle;
}

/// Degrees before segment `segment`, by chance apart.
inline double curve_before(const WeberPennLevel& level, int segment) {
  if (level.curve_back == 0 || level.curve_res <= 1) return level.curve / level.curve_res;
  return (2 * segment <= level.curve_res ? level.curve : level.curve_back) / (0.5 * level.curve_res);
}

/// Degrees by which the sky bends a stem of so many segments, at each of them.
inline double lift(const Frame& frame, double attraction, int segments) {
  const double declination = rough_acos(std::clamp(frame.heading.y, -1.0, 1.0));
  return math::degrees(attraction * declination * std::clamp(frame.up.y, -1.0, 1.0)) / segments;
}

/// Stems of one level that neither split nor sway.
class WeberPennBends {
 public:
  static constexpr std::size_t most = 32;
  static constexpr int most_segments = 16;

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == most; }
  void clear() { size_ = 0; }
  /// `key`: of its chance.
  void add(const Frame& frame, std::uint64_t key) {
    put_frame(axis_[0], size_, frame);
    key_[size_++] = key;
  }
  /// All that were added, along at most most_segments; `attraction` to the sky, 0: none.
  void reckon(const WeberPennLevel& level, double attraction);

  Frame frame(std::size_t i, int segment) const { return frame_in(axis_[segment], i); }

 private:
  std::size_t size_ = 0;
  std::uint64_t key_[most] = {};
  double axis_[most_segments][9][most] = {};
};

}  // namespace seedmesh::tree
