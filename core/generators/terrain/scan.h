#pragma once
/// Scans the samples inside a triangle, including edges, row by row with integers only, so that no sample is
/// missed.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

struct GridPoint {
  std::int32_t x = 0, z = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

inline GridPoint grid_point_of(std::uint32_t sample, std::int32_t width) {
  const auto wide = static_cast<std::uint32_t>(width);
  return {static_cast<std::int32_t>(sample % wide), static_cast<std::int32_t>(sample / wide)};
}

/// Returns twice the area of a triangle, positive for counter-clockwise order as seen from above (x east, z
/// south).
inline std::int64_t doubled_area(GridPoint a, GridPoint b, GridPoint c) {
  return std::int64_t{b.z - a.z} * (c.x - a.x) - std::int64_t{b.x - a.x} * (c.z - a.z);
}

/// The plane through three heights.
struct Plane {
  double base = 0, east = 0, south = 0;
  static Plane through(GridPoint a, GridPoint b, GridPoint c, double ha, double hb, double hc) {
    const double area = static_cast<double>(doubled_area(a, b, c));
    const double bx = b.x - a.x, bz = b.z - a.z, cx = c.x - a.x, cz = c.z - a.z;
    Plane plane;
    plane.east = ((hc - ha) * bz - (hb - ha) * cz) / area;
    plane.south = ((hb - ha) * cx - (hc - ha) * bx) / area;
    plane.base = ha - plane.east * a.x - plane.south * a.z;
    return plane;
  }
};

/// Returns the largest vertical distance of samples first .. last of a row from the line start + east * x.
/// Processes four samples at once for vector units.
inline double worst_of_row(const float* row, double start, double east, std::int32_t first,
                           std::int32_t last) {
  constexpr int lanes = 4;
  double most[lanes] = {}, position[lanes];
  for (int k = 0; k < lanes; ++k) position[k] = first + k;
  std::int32_t x = first;
  for (; x + lanes - 1 <= last; x += lanes) {
    for (int k = 0; k < lanes; ++k) {
      const double off = std::abs(static_cast<double>(row[x + k]) - (start + east * position[k]));
      most[k] = off > most[k] ? off : most[k];
      position[k] += lanes;
    }
  }
  for (; x <= last; ++x)
    most[0] = std::max(most[0], std::abs(static_cast<double>(row[x]) - (start + east * x)));
  return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

/// Walks down an edge and returns, for each row, the sample to the right of it (rounded up) or to the left
/// (rounded down).
class EdgeWalk {
 public:
  EdgeWalk(GridPoint top, GridPoint bottom) : x_(top.x), height_(bottom.z - top.z) {
    if (height_ == 0) return;
    const std::int32_t dx = bottom.x - top.x;
    if (dx == 0) return;
    if (dx == height_ || dx == -height_) {  // diagonals of right triangles need no division
      whole_ = dx > 0 ? 1 : -1;
      return;
    }
    whole_ = dx / height_;
    rest_ = dx % height_;
    if (rest_ < 0) {
      rest_ += height_;
      --whole_;
    }
  }
  void down() {
    x_ += whole_;
    carried_ += rest_;
    if (carried_ >= height_) {
      carried_ -= height_;
      ++x_;
    }
  }
  std::int32_t floor() const { return x_; }
  std::int32_t ceil() const { return x_ + (carried_ > 0 ? 1 : 0); }

 private:
  std::int32_t x_, height_, whole_ = 0, rest_ = 0, carried_ = 0;
};

/// Calls visit(z, first x, last x) for each row of the triangle, whose corners come in any order.
template <class Visit>
void each_row_inside(GridPoint a, GridPoint b, GridPoint c, const Visit& visit) {
  if (b.z < a.z) std::swap(a, b);
  if (c.z < a.z) std::swap(a, c);
  if (c.z < b.z) std::swap(b, c);
  if (a.z == c.z) return;  // no area
  EdgeWalk longest(a, c);
  // The middle corner is east or west of the longest edge. This decides which edges bound a row on which end.
  const bool middle_is_east = std::int64_t{b.x - a.x} * (c.z - a.z) > std::int64_t{c.x - a.x} * (b.z - a.z);
  std::int32_t z = a.z;
  const auto half = [&](EdgeWalk side, std::int32_t end) {
    for (; z < end; ++z, longest.down(), side.down()) {
      if (middle_is_east) {
        visit(z, longest.ceil(), side.floor());
      } else {
        visit(z, side.ceil(), longest.floor());
      }
    }
  };
  half(EdgeWalk(a, b), b.z);
  half(EdgeWalk(b, c), c.z + 1);
}

}  // namespace seedmesh::terrain
