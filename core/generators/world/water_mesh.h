#pragma once
/// The water of a tile: the sea and lakes as level squares and rectangles, rivers as ribbons. All of it is opaque.
#include "core/generators/world/glb.h"
#include "core/generators/world/ground.h"
#include "core/generators/world/terrain_grid.h"

namespace seedmesh::world {

struct WaterMesh {
  TileMesh mesh;
  double height = 0;  ///< metres at position 0
};

/// Returns the water of a tile; empty if it has none. The sea has squares where ground is below it, whose colours follow
/// its depth. Lakes have rectangles where the ground of a cell is partly below their water. Rivers and small lakes
/// follow from add_rivers().
WaterMesh water_of(const World& world, const TileFrame& frame, const TileGround& tile, Job& job);

}  // namespace seedmesh::world
