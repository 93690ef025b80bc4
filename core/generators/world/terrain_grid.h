#pragma once
/// The samples of the terrain of a tile.
#include <vector>

#include "core/generators/world/ground.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

/// Samples of a tile at `count` x `count` positions, rows from the south. If `halo` is 1, there is one more row or
/// column beyond each border.
struct TerrainGrid {
  int count = 0, halo = 0;
  double west = 0, south = 0, spacing = 0;  ///< absolute position of sample (0, 0)
  std::vector<GroundSample> samples;
  const GroundSample& at(int column, int row) const {
    const int wide = count + 2 * halo;
    return samples[static_cast<std::size_t>((row + halo) * wide + column + halo)];
  }
};
/// The terrain of a tile, on which the other layers stand. It does not own the grid.
struct TileGround {
  const TerrainGrid& grid;
  double base = 0;  ///< the height of position 0 of the tile's meshes
};
/// Samples the ground of a tile with `cells` cells a side and `halo` samples around them.
TerrainGrid sample_grid(const World& world, const TileFrame& frame, int cells, int halo, Job& job);

}  // namespace seedmesh::world
