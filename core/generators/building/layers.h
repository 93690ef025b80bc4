#pragma once
/// Distributes bodies that touch to different meshes, so that no edge of a mesh lies in more than two
/// triangles and no vertex occurs twice.
#include <span>

#include "core/generators/building/coplanar_rectangles.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// Returns the lowest free layer for each shape, in order. A layer is free for a closed body unless a body in it has
/// a corner at the same position, within 10^-5 of the diagonal. It is free for a flat face unless a face in it has an
/// edge with the same position and direction. Walls side by side, or around the corner of a house, therefore share a
/// layer. There are at most 64 layers; boxes cut in a grid need 8. Cost: about 30 ns a corner, and the same for an
/// edge if there are flat faces.
std::vector<std::uint8_t> layers_of(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                    const CoplanarRectangles& rectangles, const glm::dvec3& low,
                                    double diagonal, Job& job);

/// Moves shapes to new layers until there are `least` layers or each layer has one shape. Returns the number
/// of layers.
std::uint32_t spread(std::vector<std::uint8_t>& layers, std::size_t least);

}  // namespace seedmesh::building
