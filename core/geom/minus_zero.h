#pragma once
/// -0 becomes 0: equal numbers are equal bytes.
#include <cstddef>

#include "core/base/array.h"

namespace seedmesh {

/// Reads everything and, in the common case, writes nothing.
void clear_minus_zeros(float* numbers, std::size_t count);

/// The elements `first` to `first + count - 1`, which are made of floats; of an empty array nothing.
template <class T>
void clear_minus_zeros(Array<T>& values, std::size_t first, std::size_t count) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  if (values.empty()) return;
  clear_minus_zeros(reinterpret_cast<float*>(values.data() + first), count * sizeof(T) / sizeof(float));
}

}  // namespace seedmesh
