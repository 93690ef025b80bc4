/// Maps of boxes: references between waters, and the rounding of lengths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/generators/world/plants.h"
#include "core/generators/world/region.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

/// Boxes of 128 m around the sources of rivers: most of what these flow into lies far outside.
TEST(WorldMap, RiversNameWatersOfTheSameMap) {
  WorldParams params = mountains_with_woods();
  params.plants.clear();
  params.roads.longest = 0;
  const World world = world_of(params);
  Job job = test_job();
  const auto region = region_at(world, {0, 0}, job);
  ASSERT_GT(region->rivers.size(), 10U);
  std::set<std::string> into_lakes, into_rivers;
  for (const River& from : region->rivers) {
    const RiverPoint& source = from.points.front();
    const double east = std::floor(source.east), north = std::floor(source.north);
    const Json map = map_json(world, {east - 64, north - 64, east + 64, north + 64}, MapHeights::none, job);
    std::set<std::string> lakes, rivers;
    for (const Json& lake : map["lakes"]) ASSERT_TRUE(lakes.insert(lake["id"]).second);
    for (const Json& river : map["rivers"]) ASSERT_TRUE(rivers.insert(river["id"]).second);
    EXPECT_TRUE(rivers.contains(from.id));
    for (const Json& river : map["rivers"]) {
      const std::string into = river["into"];
      EXPECT_TRUE(into == "sea" || lakes.contains(into) || rivers.contains(into)) << river["id"] << into;
      if (lakes.contains(into)) into_lakes.insert(into);
      if (rivers.contains(into)) into_rivers.insert(into);
    }
  }
  EXPECT_GT(into_lakes.size(), 0U);
  EXPECT_GT(into_rivers.size(), 3U);
}

bool is_rounded(const Json& value) {
  if (value.is_number()) return value.get<double>() * 64 == std::floor(value.get<double>() * 64);
  return std::all_of(value.begin(), value.end(), [](const Json& part) { return is_rounded(part); });
}

TEST(WorldMap, LengthsAreMultiplesOfOne64thAndRiversStillFall) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  const Json map = map_json(world, {-8192, -8192, 8192, 8192}, MapHeights::grid, job);
  ASSERT_GT(map["rivers"].size(), 3U);
  ASSERT_GT(map["roads"].size(), 0U);
  ASSERT_GT(map["settlements"].size(), 0U);
  EXPECT_TRUE(is_rounded(map["heights"]["values"]));
  for (const Json& road : map["roads"]) EXPECT_TRUE(is_rounded(road["points"]));
  for (const Json& lake : map["lakes"]) EXPECT_TRUE(is_rounded(lake["outline"]) && is_rounded(lake["level"]));
  for (const Json& site : map["settlements"])
    EXPECT_TRUE(is_rounded(site["position"]) && is_rounded(site["radius"]));
  for (const Json& river : map["rivers"]) {
    EXPECT_TRUE(is_rounded(river["points"]) && is_rounded(river["widths"]));
    for (std::size_t k = 1; k < river["points"].size(); ++k)
      EXPECT_LE(river["points"][k][2].get<double>(), river["points"][k - 1][2].get<double>());
  }
}

/// A box around each settlement shows what it consists of; a wide box only where it lies.
TEST(WorldMap, SettlementsHaveStreetsAndHouses) {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 250;
  params.settlements.density = 1;
  params.settlements.towns.share = 0.5;
  params.plants.clear();
  const World world = world_of(params);
  Job job = test_job();
  const Json wide = map_json(world, {-20000, -20000, 20000, 20000}, MapHeights::none, job);
  std::map<std::string, int> classes, streets;
  for (const Json& found : wide["settlements"]) {
    EXPECT_FALSE(found.contains("streets"));
    const double east = found["position"][0], north = found["position"][1];
    const Json map = map_json(world, {east - 8, north - 8, east + 8, north + 8}, MapHeights::none, job);
    ASSERT_EQ(map["settlements"].size(), 1U);
    const Json& settlement = map["settlements"][0];
    EXPECT_EQ(settlement["id"], found["id"]);
    ++classes[settlement["class"]];
    EXPECT_EQ(settlement.contains("outline"), settlement["class"] == "town");
    EXPECT_GE(settlement["houses"].get<int>(), settlement["class"] == "town" ? 30 : 0);
    for (const Json& street : settlement["streets"]) {
      ++streets[street["class"]];
      EXPECT_GE(street["points"].size(), 2U);
      EXPECT_TRUE(is_rounded(street["points"]) && is_rounded(street["width"]));
    }
  }
  EXPECT_GT(classes["town"], 2);
  EXPECT_GT(classes["village"], 2);
  for (const char* kind : {"street", "lane", "farm"}) EXPECT_GT(streets[kind], 10) << kind;
}

/// Rounding moves no plant in plan, and its foot by half a step.
TEST(WorldMap, PlacesArePlantsOfLeaves) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::size_t count = 0;
  for (int k = 0; k < 40; ++k) {
    const double west = 256.0 * (37 * k % 64), south = 256.0 * (23 * k % 64);
    const Json map = map_json(world, {west, south, west + 256, south + 256}, MapHeights::none, job);
    const Rectangle box{west, south, west + 256, south + 256};
    const Ground ground = Ground::with_works(world, box, job);
    const std::vector<Plant> plants = plants_in(world, 0, box, ground, job);
    const Json& places = map["plants"][0]["places"];
    ASSERT_EQ(places.size(), plants.size());
    for (std::size_t n = 0; n < plants.size(); ++n) {
      EXPECT_TRUE(is_rounded(places[n]));
      EXPECT_EQ(places[n][0].get<double>(), plants[n].east - static_cast<double>(world.east));
      EXPECT_EQ(places[n][1].get<double>(), plants[n].north - static_cast<double>(world.north));
      EXPECT_NEAR(places[n][2].get<double>(), plants[n].height, 1.0 / 128);
    }
    count += plants.size();
  }
  EXPECT_GT(count, 1000U);
}

}  // namespace
}  // namespace seedmesh::world
