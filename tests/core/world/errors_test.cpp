/// Declared geometric errors of the presets against the ground at finer levels. They also cover plants that a tile
/// leaves out, so the presets are measured without plants, villages and roads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/generators/world/terrain_grid.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

World bare_world(const std::string& preset, std::uint64_t seed) {
  std::ifstream file(std::string(SEEDMESH_SOURCE_DIR) + "/api_schema/presets/world/" + preset + ".json");
  Json parameters = Json::parse(file)["parameters"];
  parameters["layers"] = {"terrain", "water"};
  IssueList issues;
  WorldParams params = seedmesh::read_world(parameters, "/parameters", issues);
  params.plants.clear();
  params.settlements.density = 0;
  return world_of(params, seed);
}

/// The greatest distance of samples at a quarter of the spacing from the triangles of a tile.
double measured(const World& world, const TileKey& key, Job& job) {
  constexpr int finer = 4;
  const TileFrame frame = frame_of(world, key);
  const TerrainGrid coarse = sample_grid(world, frame, frame.cells, 0, job);
  const TerrainGrid fine = sample_grid(world, frame, finer * frame.cells, 0, job);
  double most = 0;
  for (int row = 0; row < fine.count; ++row) {
    for (int column = 0; column < fine.count; ++column) {
      const int i = std::min(column / finer, frame.cells - 1), j = std::min(row / finer, frame.cells - 1);
      const double u = 1.0 * column / finer - i, v = 1.0 * row / finer - j;
      const double sw = coarse.at(i, j).height, ne = coarse.at(i + 1, j + 1).height;
      const double corner = u >= v ? coarse.at(i + 1, j).height : coarse.at(i, j + 1).height;
      const double east = u >= v ? corner - sw : ne - corner, north = u >= v ? ne - corner : corner - sw;
      const double off = std::abs(fine.at(column, row).height - (sw + u * east + v * north));
      most = std::max(most,
                      off / std::sqrt(1 + (east * east + north * north) / (coarse.spacing * coarse.spacing)));
    }
  }
  return most;
}

/// Tiles of all levels but the leaves, which have no error, in three worlds of each preset.
TEST(WorldErrors, AreNearThoseOfTheGroundInAllPresets) {
  constexpr int tiles = 200;
  for (const char* preset :
       {"temperate_land", "alpine", "archipelago", "desert_oases", "boreal_plain", "alien_plateaus"}) {
    Job job = test_job();
    std::vector<double> ratios;
    std::size_t low = 0;
    for (const std::uint64_t seed : {7U, 7919U, 15838U}) {
      const World world = bare_world(preset, seed);
      for (int n = 0; n < tiles / 3; ++n) {
        Rng rng = Rng::of_seed(static_cast<std::uint64_t>(n)).at(preset);
        const int level = n % (world.levels - 2) + 1;
        const auto along = [&] { return static_cast<std::int64_t>(rng.unit() * std::ldexp(1, level)); };
        const TileKey key{level, along(), along()};
        const double found = measured(world, key, job);
        const double declared = tile_bounds(world, key, job).geometric_error;
        if (found < 0.02) continue;  // the sea
        ratios.push_back(declared / found);
        if (declared >= found) continue;
        ++low;
        EXPECT_GT(declared, 0.7 * found)
            << preset << " " << seed << " " << key.level << "/" << key.x << "/" << key.y;
      }
    }
    ASSERT_GT(ratios.size(), 100U);
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], 2.1) << preset;
    EXPECT_LE(low, ratios.size() / 90)
        << preset << ": declared below measured in more than one of ninety tiles";
  }
}

}  // namespace
}  // namespace seedmesh::world
