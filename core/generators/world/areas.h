#pragma once
/// The contents of the tiles of one file of a tileset, measured with one grid of samples; used by bounds.cpp.
#include <algorithm>
#include <array>
#include <vector>

#include "core/generators/world/error_model.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

constexpr int levels_a_block = 4;
/// Metres; samples with this spacing or a wider one show the land without valleys.
constexpr double coarse_spacing = 128;

/// Cells of the grid of samples along the side of a link, which is a tile of the lowest level of a file. The root has
/// the widest links and is made once.
int cells_a_link(const World& world, int root_level);

/// The measurements in a square.
struct Area {
  double low = 1e12, high = -1e12;
  std::array<double, 4> borders{1e12, 1e12, 1e12, 1e12};  ///< lowest at the west, south, east and north
  double lowest = 1e12, highest = -1e12;                  ///< height range of water, roads and houses
  Roughness rough;
  double plant_height = 0;  ///< height of the tallest class that may grow here

  double border() const { return *std::min_element(borders.begin(), borders.end()); }
};

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
