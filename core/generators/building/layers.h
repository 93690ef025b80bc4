#pragma once
/// Bodies that touch are kept apart in different meshes, so that no edge of a mesh lies in more than two
/// triangles and no vertex is there twice.
#include <span>

#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// For each of the shapes the lowest layer in which none before it has a corner at the same place (to 10^-5
/// of the diagonal); at most 64 layers, of which walls cut in a grid need 8. Cost: about 30 ns a corner.
std::vector<std::uint8_t> layers_of(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                    const glm::dvec3& low, double diagonal, Job& job);

/// Gives layers of their own to shapes that have company, until there are `least` layers or all are alone.
/// How many there are then.
std::uint32_t spread(std::vector<std::uint8_t>& layers, std::size_t least);

}  // namespace seedmesh::building
