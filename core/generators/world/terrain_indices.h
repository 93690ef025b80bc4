#pragma once
/// The triangles of the terrain of a tile. They are the same in all tiles with the same number of cells, so they
/// are a file that tiles share.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

struct TerrainIndices {
  /// Indices of cells from the south-west, then of the walls of the skirt.
  std::vector<std::uint16_t> corners;
  std::string file;  ///< the same, little-endian
  std::string hash;  ///< 16 hexadecimal digits of the file
  std::uint64_t bytes() const { return 2 * corners.size() + file.size() + sizeof(TerrainIndices); }
};

/// Returns the samples of the border in order, counter-clockwise from above, starting in the south-west. The
/// skirt has a vertex below each of them, in this order, after the vertices of the ground.
std::vector<std::uint16_t> border_of_grid(int count);

/// Returns the triangles of a grid of `count` x `count` vertices with a skirt, counter-clockwise from outside.
TerrainIndices terrain_indices(int count);

/// Returns the triangles of tiles with `cells` cells along a side, from the store.
std::shared_ptr<const TerrainIndices> terrain_indices_of(const World& world, int cells, const Job& job);

}  // namespace seedmesh::world
