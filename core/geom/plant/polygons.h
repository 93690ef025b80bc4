#pragma once
/// Converts outlines to meshes of filled polygons, which may be concave.
#include <vector>

#include "core/geom/plant/limbs.h"
#include "core/geom/plant/skin.h"

namespace seedmesh {

/// Triangulates every outline in its best plane (Newell's normal).
///
/// - A polygon has a single sheet of triangles with one normal; materials are double-sided.
/// - An outline with fewer than three different vertices, or without area, is left out. Of outlines that
///   coincide the first is made.
/// - uv: the box of the outline is mapped to 0..1, u along its first edge.
/// - Polygons that share edges are oriented so that they agree on the outside, whatever direction they were
///   drawn in.
/// - The later polygon goes to the next layer (a separate manifold mesh) in two cases: an edge would be in more
///   than two triangles of a mesh, or no orientation makes all agree (a Moebius strip). Most drawings have
///   one layer.
/// - Results of one layer may become primitives of one mesh; each layer needs a mesh and a node of its own.
///
/// Returns meshes sorted by layer, then by colour; none is empty. `bones`: the bone of each joint, copied to
/// Mesh::bone; may be empty. Spends Resource::triangles. One thread. Linear time, except for large
/// outlines (triangulate.h) and for many polygons on one edge (quadratic).
std::vector<Bark> polygons(const Outlines& outlines, Job& job, std::span<const std::uint16_t> bones = {});

}  // namespace seedmesh
