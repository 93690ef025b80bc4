#pragma once
/// Transposes numbers that are stored lane by lane (organ_block.h) to rows that are stored organ by organ.
#include <algorithm>
#include <cstring>

#include "core/base/wide.h"
#include "core/geom/mesh/vec3x4.h"
#include "core/geom/plant/organ_block.h"

namespace seedmesh {

using SixteenFloats = float __attribute__((vector_size(64)));
static_assert(sizeof(SixteenFloats) == organ_lanes * sizeof(float));

/// Transposes `count` >= 4 rows, in squares of four by four: writes all rows of each lane, lane after lane.
SEEDMESH_WIDE inline void write_columns(const float* rows, std::size_t count, float* out) {
  for (std::size_t done = 0; done < count; done += Vec3x4::size) {
    const std::size_t first = std::min(done, count - Vec3x4::size);
    SixteenFloats a, b, c, d;
    std::memcpy(&a, rows + first * organ_lanes, sizeof(a));
    std::memcpy(&b, rows + (first + 1) * organ_lanes, sizeof(b));
    std::memcpy(&c, rows + (first + 2) * organ_lanes, sizeof(c));
    std::memcpy(&d, rows + (first + 3) * organ_lanes, sizeof(d));
    const SixteenFloats low = __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28,
                                                      13, 29),
                        low2 = __builtin_shufflevector(c, d, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28,
                                                       13, 29),
                        high = __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14,
                                                       30, 15, 31),
                        high2 = __builtin_shufflevector(c, d, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14,
                                                        30, 15, 31);
    // Lane k of every four.
    const SixteenFloats lane[4] = {
        __builtin_shufflevector(low, low2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
        __builtin_shufflevector(low, low2, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31),
        __builtin_shufflevector(high, high2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
        __builtin_shufflevector(high, high2, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31)};
    float* to = out + first;
    for (std::size_t k = 0; k < Vec3x4::size; ++k) {
      const Float4 quarters[4] = {__builtin_shufflevector(lane[k], lane[k], 0, 1, 2, 3),
                                  __builtin_shufflevector(lane[k], lane[k], 4, 5, 6, 7),
                                  __builtin_shufflevector(lane[k], lane[k], 8, 9, 10, 11),
                                  __builtin_shufflevector(lane[k], lane[k], 12, 13, 14, 15)};
      for (std::size_t q = 0; q < Vec3x4::size; ++q)
        std::memcpy(to + (k + Vec3x4::size * q) * count, &quarters[q], sizeof(Float4));
    }
  }
}

/// Transposes `count` rows and writes the first `organs` lanes.
inline void write_rows(const float* rows, std::size_t count, std::size_t organs, float* out) {
  if (organs == organ_lanes && count >= Vec3x4::size) return write_columns(rows, count, out);
  for (std::size_t l = 0; l < organs; ++l) {
    for (std::size_t row = 0; row < count; ++row) *out++ = rows[row * organ_lanes + l];
  }
}

}  // namespace seedmesh
