#pragma once
/// Outlines -> Mesh: filled polygons, concave ones too.
#include <vector>

#include "core/geom/limbs.h"
#include "core/geom/skin.h"

namespace seedmesh {

/// Triangulates every outline in its best plane (Newell's normal). Both sides are seen through a double-sided material, so
/// each polygon has one layer of triangles, with its own vertices and one normal. An outline with fewer than three
/// different vertices, or without area, is passed over. UVs: the outline's own box to 0..1.
std::vector<Bark> polygons(const Outlines& outlines, Job& job);

}  // namespace seedmesh
