#pragma once
/// Outlines -> Mesh: filled polygons, concave ones too.
#include <vector>

#include "core/geom/limbs.h"
#include "core/geom/skin.h"

namespace seedmesh {

/// Triangulates every outline in its best plane (Newell's normal). Both sides are seen through a double-sided
/// material, so each polygon has one layer of triangles, with one normal. An outline with fewer than three
/// different vertices, or without area, is passed over; an outline that coincides with an earlier one is made
/// once. UVs: the outline's own box to 0..1, u along its first edge.
/// Polygons that share edges are turned so that they agree on the outside, whatever the direction they were
/// drawn in. Where an edge would be in more than two triangles of a mesh, or no turning makes all agree (a
/// Moebius strip), the later polygon goes to the next layer; most drawings have one. Barks of one layer may
/// become primitives of one mesh of the answer; each layer needs a mesh (and node) of its own.
/// Out: by layer, then colour, both rising; none is empty. Spends Resource::triangles. One thread; linear but
/// for big outlines (triangulate.h) and for many polygons on one edge (their square).
/// `bones`, where it is not empty: of each joint that outlines are on, what moves it; fills Mesh::bone.
std::vector<Bark> polygons(const Outlines& outlines, Job& job, std::span<const std::uint16_t> bones = {});

}  // namespace seedmesh
