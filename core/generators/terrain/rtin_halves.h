#pragma once
/// The hierarchy of right triangles of a square field: two of them, and each halved from its right angle to
/// the middle of its long side, again and again.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/generators/terrain/rtin_errors.h"

namespace seedmesh::terrain {

/// A triangle by the numbers x + z * stride of its samples (stride_of in rtin_errors.h): its long side is a-b
/// and its right angle at c, clockwise seen from above, as both its halves then are.
struct Half {
  std::uint32_t a = 0, b = 0, c = 0;
  int level = 0;  ///< how often it can be halved; the area is half a cell twice as often

  /// Both coordinates of two ends have an even sum, so that the half is that of the place between.
  std::uint32_t middle() const { return (a + b) / 2; }
  Half first() const { return {c, a, middle(), level - 1}; }
  Half second() const { return {b, c, middle(), level - 1}; }
};

/// The triangles `depth` halvings below the two of the field, or those above that are left whole.
inline std::vector<Half> parts_of(const RtinErrors& all, float threshold, int depth) {
  const float* errors = all.data();
  int level = 0;
  for (std::int32_t i = 1; i < all.side() - 1; i *= 2) level += 2;
  const auto east = static_cast<std::uint32_t>(all.side() - 1);
  const std::uint32_t south = static_cast<std::uint32_t>(all.stride()) * east;
  std::vector<Half> parts{{0, south + east, east, level}, {south + east, 0, south, level}};
  for (; depth > 0; --depth) {
    std::vector<Half> halves;
    for (const Half& each : parts) {
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

/// The corners of such a triangle as places of the field.
struct HalfPlaces {
  Place a, b, c;
  int level = 0;
};

inline HalfPlaces places_of(const Half& half, std::int32_t stride) {
  return {place_of(half.a, stride), place_of(half.b, stride), place_of(half.c, stride), half.level};
}

/// visit(z, first x, last x) for each row of the triangle, its edges included.
template <class Visit>
void each_row_inside(const HalfPlaces& half, const Visit& visit) {
  const Place a = half.a, b = half.b, c = half.c;
  const auto row = [&](std::int32_t z, std::int32_t x, std::int32_t other) {
    visit(z, std::min(x, other), std::max(x, other));
  };
  if (half.level % 2 == 0) {  // the right angle between a row and a column
    const Place beside = a.z == c.z ? a : b, off = a.z == c.z ? b : a;
    const std::int32_t count = std::abs(off.z - c.z), down = off.z > c.z ? 1 : -1,
                       inward = beside.x > c.x ? -1 : 1;
    for (std::int32_t i = 0; i <= count; ++i) row(c.z + down * i, c.x, beside.x + inward * i);
  } else if (a.z == b.z) {  // the long side in a row
    const std::int32_t count = std::abs(c.z - a.z), down = c.z > a.z ? 1 : -1;
    for (std::int32_t i = 0; i <= count; ++i) row(a.z + down * i, c.x - (count - i), c.x + (count - i));
  } else {
    const std::int32_t count = std::abs(c.x - a.x), east = c.x > a.x ? 1 : -1;
    for (std::int32_t i = -count; i <= count; ++i) row(c.z + i, a.x, a.x + east * (count - std::abs(i)));
  }
}

/// How many triangles of the bound `threshold` are left whole within `root`, without a walk down to them:
/// each sample of the mesh inside has halved two, one on an edge one.
std::size_t count_whole(const RtinErrors& errors, float threshold, const Half& root);

/// The plane through its corners. The doubled area is a power of two: what is multiplied here is exact.
inline Plane plane_of(const HalfPlaces& half, double ha, double hb, double hc) {
  const double share = 1.0 / static_cast<double>(std::int64_t{1} << half.level);
  const Place a = half.a, b = half.b, c = half.c;
  const double bx = b.x - a.x, bz = b.z - a.z, cx = c.x - a.x, cz = c.z - a.z;
  Plane plane;
  plane.east = ((hc - ha) * bz - (hb - ha) * cz) * share;
  plane.south = ((hb - ha) * cx - (hc - ha) * bx) * share;
  plane.base = ha - plane.east * a.x - plane.south * a.z;
  return plane;
}

}  // namespace seedmesh::terrain
