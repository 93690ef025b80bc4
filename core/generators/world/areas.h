#pragma once
/// The contents of the tiles of one file of a tileset, measured with one grid of samples; used by bounds.cpp.
#include <vector>

#include "core/generators/world/area.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

constexpr int levels_a_block = 4;
/// Metres; samples with this spacing or a wider one show the land without valleys.
constexpr double coarse_spacing = 128;

/// Cells of the grid of samples along the side of a link, which is a tile of the lowest level of a file. The root has
/// the widest links and is made once.
inline int cells_a_link(const World& world, int root_level) {
  if (root_level == 0) return world.levels > 10 ? 32 : 16;
  return root_level == levels_a_block ? 32 : 8;
}

/// Returns the metres between the samples by which the boxes of the tiles of a level are found.
double spacing_of_areas(const World& world, int level);

/// The measurements in the tiles below a tile. Rows run from the south.
struct Areas {
  std::vector<Area> links;  ///< the tiles of the lowest level
  double spacing = 0;       ///< metres between samples
  /// By depth below the tile: deviations_of_tiles() of each tile.
  std::vector<std::vector<double>> deviations;
  bool has_valleys = false, has_detail = false;  ///< whether the samples have them
};

/// Returns the areas of the tiles `depth` levels below a tile.
Areas areas_below(const World& world, const TileKey& root, int depth, Job& job);

}  // namespace seedmesh::world
