#pragma once
/// Draws of many streams of chance at once, for loops under SEEDMESH_WIDE: the same bits as those of Rng.
#include <bit>

#include "core/base/rng.h"

namespace seedmesh::tree {

/// The first draw at `place` below a key, as Rng::uniform(-range, range) makes it. The conversion of 53 bits
/// is exact, and one that every processor has for several at once: both halves as the last bits of 2^52 and
/// 2^84.
inline double drawn_at(std::uint64_t key, std::uint64_t place, double range) {
  const std::uint64_t bits = key_at(key_at(key, place), 0) >> 11U;
  const auto low = std::bit_cast<double>((bits & 0xFFFFFFFFU) | 0x4330000000000000U);
  const auto high = std::bit_cast<double>((bits >> 32U) | 0x4530000000000000U);
  return -range + (range - -range) * (((high - (0x1p84 + 0x1p52)) + low) * 0x1p-53);
}

}  // namespace seedmesh::tree
