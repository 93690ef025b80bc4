#pragma once
/// A field laid on the surface of a model: displacement mapping (Cook, "Shade trees", 1984), or a normal map
/// of it (Blinn's bumps, "Simulation of wrinkled surfaces", 1978, as pictures).
///
/// The middle of the field lies at the origin of each mesh; beyond its edges it goes on mirrored, so that it
/// has none. A place of the surface takes heights from the planes across X, Y and Z, weighted by the squares
/// of its normal. Lengths are those of the meshes' own frames, before the scale of nodes.
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

/// The height of the endless mirrored field at `x` metres east and `z` metres south of its north-western
/// corner, by bilinear interpolation; margin 0 or more.
double mirrored_height(const Field& field, double x, double z);

/// Cuts every triangle into four, `rounds` times, and moves every vertex along the mean normal of its place
/// by the height there. Vertices at one place move alike, so that a closed surface stays closed. Normals that
/// were shared stay shared. Spends triangles. About 150 ns a vertex. Meshes without normals are left as they
/// are.
void displace(Model& model, const Field& field, int rounds, Job& job);

/// Gives every triangle mesh with normals a second set of texture coordinates, seen along the axis that its
/// triangle faces most, and every material in use a normal map of the field of `side` pixels that repeats.
/// Replaces normal maps and recipes of textures that there were.
void add_normal_map(Model& model, const Field& field, std::int32_t side, Job& job);

}  // namespace seedmesh::terrain
