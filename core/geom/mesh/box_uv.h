#pragma once
/// Texture coordinates for surfaces that have none.
#include "core/model/model.h"

namespace seedmesh {

/// Gives every triangle mesh without texture coordinates a box projection into uv[0]: each triangle is projected
/// along the coordinate axis nearest to its normal. Coordinates are metres, and no projection is mirrored. Vertices
/// between triangles of different directions are doubled, with the same position and normal. Lines, points and packed
/// meshes stay as they are. Indices are 32-bit before and after. Linear time; charges 8 bytes a vertex and the
/// doubled ones.
void add_box_coordinates(Model& model, Job& job);

}  // namespace seedmesh
