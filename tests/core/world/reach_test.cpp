/// Reaches of layers: tiles have the same bytes where a layer reads more than its reach, and others where it reads half.
#include <gtest/gtest.h>

#include "core/generators/world/region.h"
#include "core/generators/world/roads.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

WorldParams inhabited() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 900;
  params.water.rivers = 1;
  params.settlements.density = 1;
  params.fields.share = 0.9;
  params.plants.clear();
  return params;
}

/// Leaves, and tiles two and four levels above, around settlements and along rivers: 200 in all.
std::vector<TileKey> places(const World& world, Job& job) {
  std::vector<TileKey> keys;
  const auto add = [&](double east, double north, int above) {
    const int level = world.levels - 1 - above;
    const double side = frame_of(world, {level, 0, 0}).side;
    const TileKey key{level, static_cast<std::int64_t>(std::floor((east + world.extent / 2) / side)),
                      static_cast<std::int64_t>(std::floor((north + world.extent / 2) / side))};
    if (has_tile(world, key)) keys.push_back(key);
  };
  for (const auto& site : sites_near(world, {0, 0, 60000, 60000}, 0, job)) {
    for (const double out : {0.0, 0.5, 0.9, 1.6}) add(site->east + out * site->radius, site->north, 0);
    add(site->east, site->north, 2);
  }
  keys.resize(std::min<std::size_t>(keys.size(), 120));
  for (std::int64_t y = 0; y < 2; ++y) {
    for (std::int64_t x = 0; x < 2; ++x) {
      const auto region = region_at(world, {x, y}, job);
      std::size_t k = 0;
      for (const River& river : region->rivers) {
        const RiverPoint& p = river.points[river.points.size() / 2];
        add(p.east + 800, p.north - 300, 4);
        if (++k == 20) break;
      }
    }
  }
  return keys;
}

struct Trial {
  Reads layer;
  const char* name;
  double cell;  ///< metres, or cells of a region
};

std::size_t differences(const World& world, const std::vector<std::string>& known,
                        const std::vector<TileKey>& keys, Job& job) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < keys.size(); ++k) count += tile_glb(world, keys[k], job) != known[k] ? 1U : 0U;
  return count;
}

TEST(WorldReach, IsEnoughAndHalfOfItIsNot) {
  const World world = world_of(inhabited());
  Job job = test_job();
  const std::vector<TileKey> keys = places(world, job);
  ASSERT_GE(keys.size(), 190U);
  std::vector<std::string> known;
  for (const TileKey& key : keys) known.push_back(tile_glb(world, key, job));
  const Trial trials[] = {{Reads::cells, "cells of a region", 1}, {Reads::water, "water", drain_cell},
                          {Reads::roads, "roads", site_cell},     {Reads::works, "works", 128},
                          {Reads::fields, "fields", site_cell},   {Reads::houses, "houses", site_cell},
                          {Reads::regions, "regions", drain_cell}};
  for (const Trial& trial : trials) {
    const auto layer = static_cast<std::size_t>(trial.layer);
    World more = world_of(inhabited());
    more.reach_more[layer] = trial.cell;
    EXPECT_EQ(differences(more, known, keys, job), 0U) << trial.name << " with one cell more";
    World less = world_of(inhabited());
    less.reach_factor[layer] = 0.5;
    EXPECT_GT(differences(less, known, keys, job), 0U) << trial.name << " with half of its reach";
  }
}

}  // namespace
}  // namespace seedmesh::world
