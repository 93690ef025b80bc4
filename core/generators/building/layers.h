#pragma once
/// Bodies that touch are kept apart in different meshes, so that no edge of a mesh lies in more than two
/// triangles and no vertex is there twice.
#include <span>

#include "core/generators/building/seams.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// For each of the shapes the lowest layer that has room for it. A closed body has none where one before it
/// has a corner at the same place (to 10^-5 of the diagonal). A flat face has none where an edge of it runs
/// the same way as an edge before it: walls side by side, and round the corner of a house, share a layer. At
/// most 64 layers, of which boxes cut in a grid need 8. Cost: about 30 ns a corner, and as much an edge where
/// there are flat faces.
std::vector<std::uint8_t> layers_of(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                    const Seams& seams, const glm::dvec3& low, double diagonal, Job& job);

/// Gives layers of their own to shapes that have company, until there are `least` layers or all are alone.
/// How many there are then.
std::uint32_t spread(std::vector<std::uint8_t>& layers, std::size_t least);

}  // namespace seedmesh::building
