#include "core/generators/world/terrain_grid.h"

#include <algorithm>

#include "core/generators/world/roads.h"

namespace seedmesh::world {
namespace {
/// Samples of one Ground. Coarse samples have a Ground each: what lies between them does not matter.
constexpr double block_side = 2048;
}  // namespace

TerrainGrid sample_grid(const World& world, const TileFrame& frame, int cells, int halo, Job& job) {
  TerrainGrid grid{cells + 1, halo, frame.west, frame.south, frame.side / cells, {}};
  const int wide = grid.count + 2 * halo;
  grid.samples.resize(static_cast<std::size_t>(wide) * static_cast<std::size_t>(wide));
  const bool is_coarse = grid.spacing >= works_spacing;
  const bool is_dry = grid.spacing >= dry_spacing;
  const int block = std::clamp(static_cast<int>(block_side / grid.spacing), 1, wide);
  const auto along = [&](double from, int k) { return from + (k - halo) * grid.spacing; };
  for (int row = 0; row < wide; row += block) {
    job.check();
    for (int column = 0; column < wide; column += block) {
      const int last_row = std::min(row + block, wide), last_column = std::min(column + block, wide);
      const Rectangle box{along(grid.west, column), along(grid.south, row), along(grid.west, last_column - 1),
                          along(grid.south, last_row - 1)};
      const Ground ground = is_dry      ? Ground(world)
                            : is_coarse ? Ground(world, box, job)
                                        : Ground::with_roads(world, box, job);
      for (int j = row; j < last_row; ++j) {
        job.check();
        for (int i = column; i < last_column; ++i) {
          grid.samples[static_cast<std::size_t>(j * wide + i)] =
              ground.at(along(grid.west, i), along(grid.south, j));
        }
      }
    }
  }
  return grid;
}

}  // namespace seedmesh::world
