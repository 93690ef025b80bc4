#include "core/geom/mesh/negative_zero.h"

#include <bit>
#include <cstdint>

#include "core/base/wide.h"

namespace seedmesh {
namespace {

SEEDMESH_WIDE bool has_minus_zero(const float* values, std::size_t count) {
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found |= std::bit_cast<std::uint32_t>(values[i]) == 0x80000000U ? 1U : 0U;
  return found != 0;
}

}  // namespace

void clear_minus_zeros(float* numbers, std::size_t count) {
  if (!has_minus_zero(numbers, count)) return;
  for (std::size_t i = 0; i < count; ++i) numbers[i] += 0.0F;
}

}  // namespace seedmesh
