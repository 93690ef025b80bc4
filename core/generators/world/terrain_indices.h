#pragma once
/// The triangles of the terrain of a tile, and the coordinates of its vertices in the texture of the ground. They are the
/// same in all tiles with the same number of cells. A client that shows the ground needs all of them, so they are one
/// file that tiles share.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

/// A part of the file.
struct FilePart {
  std::size_t offset = 0, count = 0;  ///< offset in bytes; number of corners or of vertices
};

struct TerrainFile {
  FilePart indices, dense_indices;  ///< corners of 16 bits of tiles with `tile_cells` and with `dense_cells`
  FilePart coordinates, dense_coordinates;  ///< texture coordinates of the same, as pairs of floats
  std::string file;                         ///< little-endian
  std::string hash;                         ///< 16 hexadecimal digits of the file
  std::uint64_t bytes() const { return file.size() + sizeof(TerrainFile); }
};

/// Returns the samples of the border in order, counter-clockwise from above, starting in the south-west. The
/// skirt has a vertex below each of them, in this order, after the vertices of the ground.
std::vector<std::uint16_t> border_of_grid(int count);

/// Returns the corners of the triangles of a grid of `count` x `count` vertices with a skirt, counter-clockwise from
/// outside: of cells from the south-west, then of the walls of the skirt.
std::vector<std::uint16_t> terrain_indices(int count);

/// Returns the file, which is the same for all worlds, from the store; makes it if the store has none.
std::shared_ptr<const TerrainFile> terrain_file(const World& world, const Job& job);

}  // namespace seedmesh::world
