#pragma once
/// Detection of meshes that repeat one piece, as foliage does.
#include <cstddef>
#include <cstdint>

#include "core/base/array.h"

namespace seedmesh {

/// The size of one piece; 0 corners where the mesh does not repeat a piece.
struct Repeats {
  std::size_t vertices = 0, corners = 0;
};

/// Finds the smallest piece of at most 4,096 corners that the index array repeats, each time with the next
/// vertices, all of which are used. Linear time; mostly only the first corners are read.
Repeats repeats_of(const Array<std::uint32_t>& index, std::size_t vertices);

}  // namespace seedmesh
