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

using Float4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));  ///< -1 where true

/// Returns `yes` in lanes whose flag is set, and `no` in the others.
inline Float4 chosen(Mask4 flags, Float4 yes, Float4 no) {
  return reinterpret_cast<Float4>((reinterpret_cast<Mask4>(yes) & flags) |
                                  (reinterpret_cast<Mask4>(no) & ~flags));
}
/// Whether the flags of all four lanes are set.
inline bool all_of(Mask4 flags) {
  std::uint64_t halves[2];
  std::memcpy(halves, &flags, sizeof(flags));
  return (halves[0] & halves[1]) == ~std::uint64_t{0};
}
/// Returns the square root of each lane.
inline Float4 root(Float4 v) {
  return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}
/// Returns the absolute value of each lane.
inline Float4 magnitude(Float4 v) {
  return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(v) & 0x7FFFFFFF);
}

/// Returns `v` in the first three lanes, and 0 in the last.
inline Float4 spread_out(const glm::vec3& v) { return Float4{v.x, v.y, v.z, 0}; }
inline Float4 all_lanes(float value) { return Float4{value, value, value, value}; }

struct Vec3x4 {
  static constexpr std::size_t size = 4;
  Float4 x, y, z;

  /// Returns the first three lanes of four rows, transposed.
  static Vec3x4 of_rows(const Float4& a, const Float4& b, const Float4& c, const Float4& d) {
    const Float4 low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 more = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    return {__builtin_shufflevector(low, more, 0, 1, 4, 5), __builtin_shufflevector(low, more, 2, 3, 6, 7),
            __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 3, 7),
                                    __builtin_shufflevector(c, d, 2, 6, 3, 7), 0, 1, 4, 5)};
  }

  /// Returns the first `count` (1 to 4) vectors of `from`; the last one is repeated in the other lanes.
  static Vec3x4 of(const glm::vec3* from, std::size_t count = size) {
    const glm::vec3 &a = from[0], &b = from[count > 1 ? 1 : 0], &c = from[count > 2 ? 2 : count - 1],
                    &d = from[count - 1];
    return {Float4{a.x, b.x, c.x, d.x}, Float4{a.y, b.y, c.y, d.y}, Float4{a.z, b.z, c.z, d.z}};
  }
  /// Returns one vector in the first three lanes; the last lane reads the float behind it.
  static Float4 row(const glm::vec3* from) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    Float4 v;
    std::memcpy(&v, reinterpret_cast<const float*>(from), sizeof(v));
    return v;
  }
  /// Returns from[number[0]], from[number[3]], from[number[6]] and from[number[9]]: one corner of each of four
  /// triangles. Reads the float behind each.
  static Vec3x4 gather(const glm::vec3* from, const std::uint32_t* number) {
    return of_rows(row(from + number[0]), row(from + number[3]), row(from + number[6]),
                   row(from + number[9]));
  }
  glm::vec3 at(std::size_t k) const { return {x[k], y[k], z[k]}; }
  /// Writes the four vectors as rows of four floats, the last of which is 0.
  void to_rows(Float4* out) const {
    const Float4 nothing{}, low = __builtin_shufflevector(x, y, 0, 4, 1, 5),
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
    const Float4 xy = __builtin_shufflevector(x, y, 0, 4, 1, 5) + 0.0F,
                 xy2 = __builtin_shufflevector(x, y, 2, 6, 3, 7) + 0.0F, third = z + 0.0F;
    const Float4 zx = __builtin_shufflevector(third, xy, 0, 6, 1, 1),
                 zx2 = __builtin_shufflevector(third, xy2, 2, 6, 3, 3);
    const Float4 rows[3] = {
        __builtin_shufflevector(xy, zx, 0, 1, 4, 5),
        __builtin_shufflevector(__builtin_shufflevector(xy, third, 3, 5, 3, 5), xy2, 0, 1, 4, 5),
        __builtin_shufflevector(zx2, xy2, 0, 1, 7, 2)};
    std::memcpy(static_cast<void*>(to), rows, sizeof(rows));
  }
};

inline Float4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 scaled(const Vec3x4& v, Float4 by) { return {v.x * by, v.y * by, v.z * by}; }
inline Vec3x4 divided(const Vec3x4& v, Float4 by) { return {v.x / by, v.y / by, v.z / by}; }
inline Vec3x4 sum(const Vec3x4& a, const Vec3x4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3x4 difference(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

/// Returns math::quick_unit() of each vector.
inline Vec3x4 units(const Vec3x4& v, const Vec3x4& otherwise) {
  const Float4 square = dot(v, v);
  if (all_of((square > 1e-30F) & (square < 1e30F))) return divided(v, root(square));
  Vec3x4 out{};
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
