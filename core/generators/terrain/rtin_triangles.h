#pragma once
/// The hierarchy of right triangles of a square field: two triangles, each split recursively from its right
/// angle to the midpoint of its long side.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/generators/terrain/rtin_errors.h"

namespace seedmesh::terrain {

/// A triangle by the sample numbers x + z * stride (stride_of in rtin_errors.h). Its long side is a-b and its
/// right angle is at c. Its corners are counter-clockwise as seen from above, and so are those of both halves.
struct RtinTriangle {
  std::uint32_t a = 0, b = 0, c = 0;
  int level = 0;  ///< number of splits down to half a cell; the area doubles with each level

  /// The coordinates of the two ends have even sums, so the mean number is that of the midpoint.
  std::uint32_t middle() const { return (a + b) / 2; }
  RtinTriangle first() const { return {c, a, middle(), level - 1}; }
  RtinTriangle second() const { return {b, c, middle(), level - 1}; }
};

/// Splits the two triangles of the field `depth` times. Triangles whose error is at most `threshold` stay whole.
inline std::vector<RtinTriangle> parts_of(const RtinErrors& all, float threshold, int depth) {
  const float* errors = all.data();
  int level = 0;
  for (std::int32_t i = 1; i < all.side() - 1; i *= 2) level += 2;
  const auto east = static_cast<std::uint32_t>(all.side() - 1);
  const std::uint32_t south = static_cast<std::uint32_t>(all.stride()) * east;
  std::vector<RtinTriangle> parts{{0, south + east, east, level}, {south + east, 0, south, level}};
  for (; depth > 0; --depth) {
    std::vector<RtinTriangle> halves;
    for (const RtinTriangle& each : parts) {
      if (each.level == 0 || !(errors[each.middle()] > threshold)) {
        halves.push_back(each);
      } else {
        halves.push_back(each.first());
        halves.push_back(each.second());
      }
    }
    parts = std::move(halves);
  }
  return parts;
}

/// The corners of a triangle as positions in the field.
struct RtinTriangleCorners {
  GridPoint a, b, c;
  int level = 0;
};

inline RtinTriangleCorners corners_of(const RtinTriangle& half, std::int32_t stride) {
  return {grid_point_of(half.a, stride), grid_point_of(half.b, stride), grid_point_of(half.c, stride),
          half.level};
}

/// Calls visit(z, first x, last x) for each row of the triangle, including its edges.
template <class Visit>
void each_row_inside(const RtinTriangleCorners& half, const Visit& visit) {
  const GridPoint a = half.a, b = half.b, c = half.c;
  const auto row = [&](std::int32_t z, std::int32_t x, std::int32_t other) {
    visit(z, std::min(x, other), std::max(x, other));
  };
  if (half.level % 2 == 0) {  // the legs lie along a row and a column
    const GridPoint beside = a.z == c.z ? a : b, off = a.z == c.z ? b : a;
    const std::int32_t count = std::abs(off.z - c.z), down = off.z > c.z ? 1 : -1,
                       inward = beside.x > c.x ? -1 : 1;
    for (std::int32_t i = 0; i <= count; ++i) row(c.z + down * i, c.x, beside.x + inward * i);
  } else if (a.z == b.z) {  // the long side lies along a row
    const std::int32_t count = std::abs(c.z - a.z), down = c.z > a.z ? 1 : -1;
    for (std::int32_t i = 0; i <= count; ++i) row(a.z + down * i, c.x - (count - i), c.x + (count - i));
  } else {
    const std::int32_t count = std::abs(c.x - a.x), east = c.x > a.x ? 1 : -1;
    for (std::int32_t i = -count; i <= count; ++i) row(c.z + i, a.x, a.x + east * (count - std::abs(i)));
  }
}

/// Counts the triangles within `root` of the mesh whose error is at most `threshold`, without recursion. A mesh sample
/// inside `root` splits two triangles, one on an edge splits one.
std::size_t count_triangles(const RtinErrors& errors, float threshold, const RtinTriangle& root);

/// Returns the plane through the corners. Twice the area is a power of two, so the products here are exact.
inline Plane plane_of(const RtinTriangleCorners& half, double ha, double hb, double hc) {
  const double share = 1.0 / static_cast<double>(std::int64_t{1} << half.level);
  const GridPoint a = half.a, b = half.b, c = half.c;
  const double bx = b.x - a.x, bz = b.z - a.z, cx = c.x - a.x, cz = c.z - a.z;
  Plane plane;
  plane.east = ((hc - ha) * bz - (hb - ha) * cz) * share;
  plane.south = ((hb - ha) * cx - (hc - ha) * bx) * share;
  plane.base = ha - plane.east * a.x - plane.south * a.z;
  return plane;
}

}  // namespace seedmesh::terrain
