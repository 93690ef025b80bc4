/// Declared geometric errors of the presets against the ground at finer levels. They also cover plants that a tile
/// leaves out, so the presets are measured without plants, villages and roads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
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
  const TerrainGrid fine = sample_grid(world, frame, finer * frame.cells, 0, job);
  const auto corner = [&](int i, int j) { return fine.at(finer * i, finer * j).height; };
  double most = 0;
  for (int row = 0; row < fine.count; ++row) {
    for (int column = 0; column < fine.count; ++column) {
      const int i = std::min(column / finer, frame.cells - 1), j = std::min(row / finer, frame.cells - 1);
      const double u = 1.0 * column / finer - i, v = 1.0 * row / finer - j;
      const double sw = corner(i, j), ne = corner(i + 1, j + 1);
      const double third = u >= v ? corner(i + 1, j) : corner(i, j + 1);
      const double east = u >= v ? third - sw : ne - third, north = u >= v ? ne - third : third - sw;
      const double off = std::abs(fine.at(column, row).height - (sw + u * east + v * north));
      most = std::max(most,
                      off / std::sqrt(1 + (east * east + north * north) / (frame.spacing * frame.spacing)));
    }
  }
  return most;
}

constexpr int default_paths = 6;

/// The number of paths in the worlds of a preset; the environment may ask for more.
int number_of_paths() {
  const char* given = std::getenv("SEEDMESH_WORLD_PATHS");  // NOLINT(concurrency-mt-unsafe)
  return given ? std::max(1, std::atoi(given)) : default_paths;
}

/// Tiles of all levels but the leaves, which have no error, on paths from the root in three worlds of each preset.
/// Tiles of a path share their tilesets, which take most of the time. The widest tiles need
/// the drainage of wide areas, so only the first path of a world has them. With SEEDMESH_WORLD_PATHS=32, 2,100 tiles.
TEST(WorldErrors, AreNotBelowThoseOfTheGroundInAnyPreset) {
  const int paths = number_of_paths();
  std::size_t tiles = 0, low = 0;
  for (const char* preset :
       {"temperate_land", "alpine", "archipelago", "desert_oases", "boreal_plain", "alien_plateaus"}) {
    Job job = test_job();
    const std::array<World, 3> worlds{bare_world(preset, 7), bare_world(preset, 7919),
                                      bare_world(preset, 15838)};
    std::vector<double> ratios;
    for (int path = 0; path < paths; ++path) {
      const World& world = worlds[static_cast<std::size_t>(path) % worlds.size()];
      Rng rng = Rng::of_seed(static_cast<std::uint64_t>(path)).at(preset);
      const int last = world.levels - 1;
      const auto along = [&] { return static_cast<std::int64_t>(rng.unit() * std::ldexp(1, last)); };
      const TileKey leaf{last, along(), along()};
      const int first = static_cast<std::size_t>(path) < worlds.size() ? 1 : 3;
      for (int level = first; level < last; ++level) {
        const TileKey key{level, leaf.x >> (last - level), leaf.y >> (last - level)};
        const double found = measured(world, key, job);
        if (found < 0.02) continue;  // the sea
        const double declared = tile_bounds(world, key, job).geometric_error;
        low += declared < found ? 1U : 0U;
        ++tiles;
        ratios.push_back(declared / found);
      }
    }
    ASSERT_GT(ratios.size(), 9U * static_cast<std::size_t>(paths));
    std::sort(ratios.begin(), ratios.end());
    // Two, with the spread of a median over few tiles.
    EXPECT_LE(ratios[ratios.size() / 2], 2.1) << preset;
    if (paths > default_paths) {
      std::printf("%s: %zu tiles, median of declared by measured errors %.2f\n", preset, ratios.size(),
                  ratios[ratios.size() / 2]);
    }
  }
  // Errors are estimated from samples: of 2,139 tiles one is declared four percent below the measured one.
  EXPECT_LE(low, tiles / 1000);
}

/// Beds of rivers of 60 m and more are the greatest deviations of plains.
TEST(WorldErrors, AllowForTheBedsOfWideRivers) {
  WorldParams params;
  params.relief.mountains = 0;
  params.relief.hills = 10;
  params.relief.gullies = 0;
  params.relief.land = 0.8;
  params.water.width = 60;
  params.water.rivers = 0.8;
  params.settlements.density = 0;
  const World world = world_of(params);
  Job job = test_job();
  int tiles = 0, low = 0;
  for (std::int64_t k = 0; k < 256; ++k) {
    const TileKey key{8, 128 + k % 16, 128 + k / 16};
    const TileFrame frame = frame_of(world, key);
    const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
    const Ground water(world, box, job, 0);
    const bool is_wide = std::any_of(water.reaches().begin(), water.reaches().end(),
                                     [](const Reach& reach) { return reach.from.width > 60; });
    if (!is_wide || tiles == 24) continue;
    const double found = measured(world, key, job);
    ++tiles;
    low += tile_bounds(world, key, job).geometric_error < found ? 1 : 0;
  }
  EXPECT_EQ(tiles, 24);
  EXPECT_EQ(low, 0);
}

}  // namespace
}  // namespace seedmesh::world
