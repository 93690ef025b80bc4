#pragma once
/// Replacement of -0 by 0, so that equal numbers have equal bytes.
#include <cstddef>

#include "core/base/array.h"

namespace seedmesh {

/// Replaces -0 in `numbers`. Writes nothing where there is no -0.
void clear_minus_zeros(float* numbers, std::size_t count);

/// Replaces -0 in the elements first to first + count - 1, which consist of floats. Does nothing for an empty
/// array.
template <class T>
void clear_minus_zeros(Array<T>& values, std::size_t first, std::size_t count) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  if (values.empty()) return;
  clear_minus_zeros(reinterpret_cast<float*>(values.data() + first), count * sizeof(T) / sizeof(float));
}

}  // namespace seedmesh
