#pragma once
/// Applies a field to the surface of a model: by displacement mapping (Cook, "Shade trees", 1984), or as a
/// normal map (Blinn, "Simulation of wrinkled surfaces", 1978).
///
/// The centre of the field is at the origin of each mesh. The field continues mirrored beyond its edges.
/// Heights are projected along X, Y and Z and blended by the squares of the normal's components. Lengths are
/// in the frame of the mesh; the scale of nodes is not applied.
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

/// Returns the height of the infinite mirrored field at `x` metres east and `z` metres south of its
/// north-west corner, by bilinear interpolation. The margin of the field is not used.
double mirrored_height(const Field& field, double x, double z);

/// Splits every triangle into four, `rounds` times, and moves every vertex by the height along the mean
/// normal at its position. Vertices whose distance is below 1e-6 of the diagonal get the same displacement,
/// so a closed surface stays closed. Vertices that shared a normal still share it. Tangents are removed.
/// Meshes without normals are unchanged. Spends triangles. Cost: about 150 ns for each vertex.
void displace(Model& model, const Field& field, int rounds, Job& job);

/// Writes the second set of texture coordinates of every triangle mesh with normals, projected along the dominant axis
/// of each triangle. Every material of such a mesh gets a repeating normal map of the field with `side` pixels a side.
/// It replaces existing normal maps and texture recipes. A mesh without a material gets one. Tangents are removed.
void add_normal_map(Model& model, const Field& field, std::int32_t side, Job& job);

}  // namespace seedmesh::terrain
