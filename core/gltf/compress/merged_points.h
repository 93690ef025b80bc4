#pragma once
/// Different vertices that quantization has moved to one grid point.
#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Moves vertices of a quantized part to free neighbouring grid points in two cases:
/// - vertices with different `exact` positions share a point, and an edge would have more than two faces (a
///   pinched tube);
/// - the corners of a triangle lie on a line, and its removal would leave a hole.
/// Triangles that collapse to an edge or to a point are left as they are. Returns false if edges with more
/// than two faces remain, because the grid is too coarse for the part. Cost: 20 ns and 8 to 16 bytes for each
/// vertex.
bool split_merged_points(Part& part, const Slice& exact, Job& job);

}  // namespace seedmesh::gltf
