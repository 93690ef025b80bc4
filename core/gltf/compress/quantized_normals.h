#pragma once
/// Repair of normals after quantization. The direction of a face that is hardly larger than a step of the
/// quantization grid changes when its corners move to grid points.
#include <vector>

#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Returns the corners (three for each triangle, ascending) whose normal faces away from their triangle, in a
/// part before quantization. Meshes of this program have none; an imported GLB may.
std::vector<std::size_t> inward_corners(const Part& part, Job& job);

/// Finds the corners whose quantized normal faces away from their quantized triangle. Each gets a vertex of
/// its own with the normal of the triangle. Leaves the corners in `inward` as they are.
void repair_quantized_normals(Part& part, const std::vector<std::size_t>& inward, Job& job);

}  // namespace seedmesh::gltf
