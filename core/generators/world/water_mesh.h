#pragma once
/// The water of a tile: the sea and lakes as level rectangles, rivers as ribbons. All of it is opaque.
#include "core/generators/world/glb.h"
#include "core/generators/world/ground.h"
#include "core/generators/world/terrain_grid.h"

namespace seedmesh::world {

struct WaterMesh {
  TileMesh mesh;
  double height = 0;  ///< metres at position 0
};

/// Empty where the tile has no water. The sea is one rectangle wherever the tile has ground below it; those of lakes
/// lie where the ground of a cell is partly below the water. Rivers and small lakes follow from add_rivers().
WaterMesh water_of(const World& world, const TileFrame& frame, const TileGround& tile, Job& job);

}  // namespace seedmesh::world
