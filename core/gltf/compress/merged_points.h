#pragma once
/// Different vertices that quantization has moved to one grid point.
#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Moves vertices of a quantized part to free neighbouring grid points where the surface needs it: where
/// vertices with different `exact` positions share a point and an edge would have more than two faces (a
/// pinched tube), and where the corners of a triangle lie on a line, whose removal would leave a hole. Edges
/// and points that a triangle collapses to stay as they are. 20 ns and 8 to 16 bytes for each vertex. Returns
/// false where edges with more than two faces remain, because the grid is too coarse for the part.
bool part_merged_points(Part& part, const Slice& exact, Job& job);

}  // namespace seedmesh::gltf
