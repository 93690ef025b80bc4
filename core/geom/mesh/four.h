#pragma once
/// Four vectors side by side, for the vector extensions of GCC and Clang. Each lane has the same bits as the
/// functions of glm and math.h have for one vector.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>

#include "core/base/quick_math.h"

namespace seedmesh {

using FourFloats = float __attribute__((vector_size(16)));
using FourFlags = std::int32_t __attribute__((vector_size(16)));  ///< -1 where true

/// Returns `yes` in lanes whose flag is set, and `no` in the others.
inline FourFloats chosen(FourFlags flags, FourFloats yes, FourFloats no) {
  return reinterpret_cast<FourFloats>((reinterpret_cast<FourFlags>(yes) & flags) |
                                      (reinterpret_cast<FourFlags>(no) & ~flags));
}
/// Whether the flags of all four lanes are set.
inline bool all_of(FourFlags flags) {
  std::uint64_t halves[2];
  std::memcpy(halves, &flags, sizeof(flags));
  return (halves[0] & halves[1]) == ~std::uint64_t{0};
}
/// Returns the square root of each lane.
inline FourFloats root(FourFloats v) {
  return FourFloats{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}
/// Returns the absolute value of each lane.
inline FourFloats magnitude(FourFloats v) {
  return reinterpret_cast<FourFloats>(reinterpret_cast<FourFlags>(v) & 0x7FFFFFFF);
}

/// Returns `v` in the first three lanes, and 0 in the last.
inline FourFloats spread_out(const glm::vec3& v) { return FourFloats{v.x, v.y, v.z, 0}; }
inline FourFloats all_lanes(float value) { return FourFloats{value, value, value, value}; }

struct Four {
  static constexpr std::size_t size = 4;
  FourFloats x, y, z;

  /// Returns the first three lanes of four rows, transposed.
  static Four of_rows(const FourFloats& a, const FourFloats& b, const FourFloats& c, const FourFloats& d) {
    const FourFloats low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                     more = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    return {__builtin_shufflevector(low, more, 0, 1, 4, 5), __builtin_shufflevector(low, more, 2, 3, 6, 7),
            __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 3, 7),
                                    __builtin_shufflevector(c, d, 2, 6, 3, 7), 0, 1, 4, 5)};
  }

  /// Returns the first `count` (1 to 4) vectors of `from`; the last one is repeated in the other lanes.
  static Four of(const glm::vec3* from, std::size_t count = size) {
    const glm::vec3 &a = from[0], &b = from[count > 1 ? 1 : 0], &c = from[count > 2 ? 2 : count - 1],
                    &d = from[count - 1];
    return {FourFloats{a.x, b.x, c.x, d.x}, FourFloats{a.y, b.y, c.y, d.y}, FourFloats{a.z, b.z, c.z, d.z}};
  }
  /// Returns one vector in the first three lanes; the last lane reads the float behind it.
  static FourFloats row(const glm::vec3* from) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    FourFloats v;
    std::memcpy(&v, reinterpret_cast<const float*>(from), sizeof(v));
    return v;
  }
  /// Returns from[number[0]], from[number[3]], from[number[6]] and from[number[9]]: one corner of each of four
  /// triangles. Reads the float behind each.
  static Four picked(const glm::vec3* from, const std::uint32_t* number) {
    return of_rows(row(from + number[0]), row(from + number[3]), row(from + number[6]),
                   row(from + number[9]));
  }
  glm::vec3 at(std::size_t k) const { return {x[k], y[k], z[k]}; }
  /// Writes the four vectors as rows of four floats, the last of which is 0.
  void to_rows(FourFloats* out) const {
    const FourFloats nothing{}, low = __builtin_shufflevector(x, y, 0, 4, 1, 5),
                                high = __builtin_shufflevector(x, y, 2, 6, 3, 7),
                                low_z = __builtin_shufflevector(z, nothing, 0, 4, 1, 5),
                                high_z = __builtin_shufflevector(z, nothing, 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(low, low_z, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(low, low_z, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(high, high_z, 0, 1, 4, 5);
    out[3] = __builtin_shufflevector(high, high_z, 2, 3, 6, 7);
  }

  /// Writes all four vectors in sequence, with -0 replaced by 0.
  void write(glm::vec3* to) const {
    const FourFloats xy = __builtin_shufflevector(x, y, 0, 4, 1, 5) + 0.0F,
                     xy2 = __builtin_shufflevector(x, y, 2, 6, 3, 7) + 0.0F, third = z + 0.0F;
    const FourFloats zx = __builtin_shufflevector(third, xy, 0, 6, 1, 1),
                     zx2 = __builtin_shufflevector(third, xy2, 2, 6, 3, 3);
    const FourFloats rows[3] = {
        __builtin_shufflevector(xy, zx, 0, 1, 4, 5),
        __builtin_shufflevector(__builtin_shufflevector(xy, third, 3, 5, 3, 5), xy2, 0, 1, 4, 5),
        __builtin_shufflevector(zx2, xy2, 0, 1, 7, 2)};
    std::memcpy(static_cast<void*>(to), rows, sizeof(rows));
  }
};

inline FourFloats dot(const Four& a, const Four& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Four scaled(const Four& v, FourFloats by) { return {v.x * by, v.y * by, v.z * by}; }
inline Four divided(const Four& v, FourFloats by) { return {v.x / by, v.y / by, v.z / by}; }
inline Four sum(const Four& a, const Four& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Four difference(const Four& a, const Four& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Four cross(const Four& a, const Four& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

/// Returns math::quick_unit() of each vector.
inline Four units(const Four& v, const Four& otherwise) {
  const FourFloats square = dot(v, v);
  if (all_of((square > 1e-30F) & (square < 1e30F))) return divided(v, root(square));
  Four out{};
  for (int k = 0; k < 4; ++k) {
    const glm::vec3 unit =
        math::quick_unit({v.x[k], v.y[k], v.z[k]}, {otherwise.x[k], otherwise.y[k], otherwise.z[k]});
    out.x[k] = unit.x;
    out.y[k] = unit.y;
    out.z[k] = unit.z;
  }
  return out;
}

}  // namespace seedmesh
