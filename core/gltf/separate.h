#pragma once
/// Points of a mesh that a grid lets fall together although the surface between them needs them apart.
#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Moves vertices of a part whose positions are quantized to free points of the grid beside theirs: where two
/// that stood apart (`exact` positions) came to one point and an edge would have more than two faces, as
/// where a thin tube is pinched; and where the three corners of a triangle came to a line, whose loss would
/// leave a hole. What shrinks to an edge or a point is left as it is. 20 ns and 8 to 16 bytes a vertex.
/// False: edges of more than two faces are left, for the grid is too coarse for the part.
bool separate(Part& part, const Slice& exact, Job& job);

}  // namespace seedmesh::gltf
