#pragma once
/// Meshes that are one piece again and again, as leaves are.
#include <cstddef>
#include <cstdint>

#include "core/base/array.h"

namespace seedmesh {

/// How much of such a mesh one piece is; 0 corners: it is none.
struct Repeats {
  std::size_t vertices = 0, corners = 0;
};

/// The smallest piece of at most 4,096 corners whose triangles come again and again, each time with the next
/// vertices, all of which are in use. Linear time, seldom more than a look at the first corners.
Repeats repeats_of(const Array<std::uint32_t>& index, std::size_t vertices);

}  // namespace seedmesh
