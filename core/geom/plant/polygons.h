#pragma once
/// Converts outlines to meshes of filled polygons, which may be concave.
#include <vector>

#include "core/geom/plant/limbs.h"
#include "core/geom/plant/skin.h"

namespace seedmesh {

/// Triangulates every outline in its best plane (Newell's normal).
///
/// - A polygon has a single sheet of triangles with one normal; materials are double-sided.
/// - An outline with fewer than three different vertices, or without area, is left out. If several
///   outlines coincide, only the first becomes triangles.
/// - Texture coordinates map the bounding box of the outline to 0..1. The u axis is parallel to its first edge.
/// - Polygons that share edges are oriented so that they agree on the outside, whatever direction they were
///   drawn in.
/// - A layer is a separate manifold mesh. A polygon goes to the next layer in two cases: an edge would have more
///   than two triangles, or no orientation makes all polygons agree (a Moebius strip). Most drawings have one
///   layer.
/// - Meshes of one layer may become primitives of one glTF mesh. Each layer needs a glTF mesh and a node of its own.
///
/// Returns meshes sorted by layer, then by colour; none is empty. `bones`: the bone of each joint, copied to
/// Mesh::bone; may be empty. Spends Resource::triangles. One thread. Linear time, except for large
/// outlines (triangulate.h) and for many polygons on one edge (quadratic).
std::vector<Bark> polygons(const Outlines& outlines, Job& job, std::span<const std::uint16_t> bones = {});

}  // namespace seedmesh
