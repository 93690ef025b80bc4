/// Boxes and errors of tiles against their contents, in worlds with random parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

/// Parameters between plains and high mountains, deserts and woods.
WorldParams random_params(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed).at("parameters");
  WorldParams params;
  params.extent = rng.unit() < 0.3 ? 32768 : rng.unit() < 0.5 ? 262144 : 1048576;
  params.relief.mountains = rng.unit() < 0.3 ? 0 : 3500 * rng.unit() * rng.unit();
  params.relief.hills = 400 * rng.unit() * rng.unit();
  params.relief.ridges = rng.unit();
  params.relief.gullies = rng.unit();
  params.relief.terraces = rng.unit() < 0.7 ? 0 : rng.unit();
  params.relief.land = rng.uniform(0.3, 1);
  params.relief.sea = rng.unit() < 0.7;
  params.relief.continents = rng.uniform(20000, 400000);
  params.water.rivers = rng.unit();
  params.water.width = rng.uniform(2, 60);
  params.settlements.density = rng.unit();
  params.roads.longest = rng.unit() < 0.3 ? 0 : 8000;
  if (rng.unit() < 0.6) {
    WorldClass tree;
    tree.class_name = "tree";
    tree.height = rng.uniform(2, 25);
    tree.moisture = {rng.uniform(0, 0.6), 1};
    params.plants = {tree};
  }
  if (rng.unit() < 0.3) params.relief.sea_level = rng.uniform(-500, 500);
  return params;
}

/// Finer vertices from the planes of coarser triangles, as greatest distance.
double deviation(const Terrain& coarse, double spacing, double west, double south, const Terrain& fine) {
  double most = 0;
  for (const auto& [at, vertex] : fine) {
    const double x = west + std::floor((at.first - west) / spacing) * spacing,
                 y = south + std::floor((at.second - south) / spacing) * spacing;
    const double u = (at.first - x) / spacing, v = (at.second - y) / spacing;
    const auto a = coarse.find({x, y}), b = coarse.find({x + spacing, y + spacing});
    if (a == coarse.end() || b == coarse.end()) continue;
    const auto c = u >= v ? coarse.find({x + spacing, y}) : coarse.find({x, y + spacing});
    const double ha = a->second.top, hb = b->second.top, hc = c->second.top;
    const double east = u >= v ? hc - ha : hb - hc, north = u >= v ? hb - hc : hc - ha;
    const double off = std::abs(vertex.top - (ha + u * east + v * north));
    most = std::max(most, off / std::sqrt(1 + (east * east + north * north) / (spacing * spacing)));
  }
  return most;
}

bool is_inside(const ContentBox& content, const TileBounds& box) {
  return content.low[0] >= box.west && content.low[1] >= box.south && content.low[2] >= box.low &&
         content.high[0] <= box.east && content.high[1] <= box.north && content.high[2] <= box.high;
}

/// Expects that the content of a tile is in its box.
void expect_inside(const World& world, std::uint64_t seed, const TileKey& key, Job& job) {
  const ContentBox content = content_of(tile_glb(world, key, job));
  const TileBounds box = tile_bounds(world, key, job);
  EXPECT_TRUE(is_inside(content, box))
      << "world " << seed << " tile " << key.level << "/" << key.x << "/" << key.y << ": content from "
      << content.low[2] << " to " << content.high[2] << ", box from " << box.low << " to " << box.high;
}

struct Found {
  int tiles = 0;
  std::vector<double> empty, ratios;  ///< shares of heights of boxes; errors by deviations
};

/// Looks at three more tiles of the level below the tileset that has a tile. The widest levels need the drainage of wide
/// areas, and have few tiles.
void look_beside(const World& world, std::uint64_t seed, const TileKey& key, Rng& rng, Job& job) {
  const int above = key.level == 0 ? 0 : (key.level - 1) % 4 + 1;
  if (above == 0 || frame_of(world, key).side > 8192) return;
  const std::int64_t side = std::int64_t{1} << above;
  const auto beside = [&](std::int64_t k) {
    return k / side * side + static_cast<std::int64_t>(rng.unit() * static_cast<double>(side));
  };
  for (int k = 0; k < 3; ++k) {
    const std::int64_t x = beside(key.x), y = beside(key.y);
    expect_inside(world, seed, {key.level, x, y}, job);
  }
}

/// `bare`: the same world without plants, whose errors are those of the ground alone.
void walk(const World& world, const World& bare, std::uint64_t seed, Job& job, Found& found) {
  Rng rng = Rng::of_seed(seed).at("walk");
  const int last = world.levels - 1;
  const TileKey leaf{last, static_cast<std::int64_t>(rng.unit() * std::ldexp(1, last)),
                     static_cast<std::int64_t>(rng.unit() * std::ldexp(1, last))};
  std::vector<Terrain> terrains;
  std::vector<TileBounds> boxes;
  for (int level = 0; level <= last; ++level) {
    const TileKey key{level, leaf.x >> (last - level), leaf.y >> (last - level)};
    const std::string glb = tile_glb(world, key, job);
    const TileBounds box = tile_bounds(world, key, job);
    const ContentBox content = content_of(glb);
    ++found.tiles;
    EXPECT_TRUE(is_inside(content, box))
        << "world " << seed << " level " << level << ": content from " << content.low[2] << " to "
        << content.high[2] << ", box from " << box.low << " to " << box.high;
    look_beside(world, seed, key, rng, job);
    found.empty.push_back(1 - (content.high[2] - content.low[2]) / (box.high - box.low));
    if (level > 0) {
      EXPECT_GE(box.low, boxes.back().low);
      EXPECT_LE(box.high, boxes.back().high);
      EXPECT_LT(box.geometric_error, boxes.back().geometric_error);
    }
    terrains.push_back(terrain_of(glb));
    boxes.push_back(box);
  }
  for (int level = 0; level < last; ++level) {
    const double side = world.extent / std::ldexp(1, level);
    const double west = static_cast<double>(leaf.x >> (last - level)) * side - world.extent / 2,
                 south = static_cast<double>(leaf.y >> (last - level)) * side - world.extent / 2;
    for (const int finer : {level + 1, level + 3, last}) {
      if (finer > last) continue;
      const TileKey key{level, leaf.x >> (last - level), leaf.y >> (last - level)};
      const double spacing = frame_of(world, key).spacing;
      const double off = deviation(terrains[static_cast<std::size_t>(level)], spacing, west, south,
                                   terrains[static_cast<std::size_t>(finer)]);
      const double said = boxes[static_cast<std::size_t>(level)].geometric_error;
      EXPECT_LE(off, said) << "world " << seed << " level " << level << " against " << finer;
      if (finer == level + 1 && off > 0 && frame_of(world, {finer, 0, 0}).spacing < spacing)
        found.ratios.push_back(tile_bounds(bare, key, job).geometric_error / off);
    }
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Worlds with random parameters, each from the root to a leaf.
TEST(WorldBounds, HoldContentsAndDeclareErrorsThatTheyHave) {
  // those from 26 on had skirts or water outside of their boxes
  constexpr std::array<std::uint64_t, 21> seeds{1,  2,  3,  4,  5,  6,  7,   8,   9,   10, 11,
                                                12, 13, 14, 15, 16, 26, 129, 256, 417, 0};
  Found found;
  Job job = test_job();
  for (const std::uint64_t seed : seeds) {
    const WorldParams params = random_params(seed);
    WorldParams without = params;
    without.plants.clear();
    walk(world_of(params, seed), world_of(without, seed), seed, job, found);
  }
  EXPECT_GT(found.tiles, 160);
  EXPECT_LE(median(found.empty), 0.25) << "half of the boxes are emptier";
  // a tile of the next level has a quarter of the area, so it often misses what is roughest
  EXPECT_LE(median(found.ratios), 2.6) << "declared errors by deviations from the next level";
}

World world_of_text(const char* parameters, std::uint64_t seed) {
  IssueList issues;
  const WorldParams params = seedmesh::read_world(Json::parse(parameters), "/parameters", issues);
  EXPECT_TRUE(issues.empty());
  return world_of(params, seed);
}

/// Whether a skirt hides what is between a vertex at the border of a tile and the border of a coarser tile.
bool is_hidden(const TerrainVertex& vertex, const Terrain& coarse, double east, double north,
               double spacing) {
  const double from = std::floor(north / spacing) * spacing, t = (north - from) / spacing;
  const auto a = coarse.find({east, from}), b = t > 0 ? coarse.find({east, from + spacing}) : a;
  if (a == coarse.end() || b == coarse.end()) return false;
  const double top = a->second.top + t * (b->second.top - a->second.top),
               low = a->second.low + t * (b->second.low - a->second.low);
  return vertex.top > top ? vertex.low <= top : low <= vertex.top;
}

/// No tile is beside the root, and none beside tiles of level 1 is coarser. Their skirts were four to six times as deep
/// as their errors, because they allowed for tiles three levels coarser.
TEST(WorldBounds, HoldSkirtsThatAreAsDeepAsTheCoarsestNeighbourNeeds) {
  const World world = world_of_text(R"({"extent":32768,"relief":{"mountains":1500,"land":1}})", 7);
  Job job = test_job();
  for (const int level : {0, 1}) {
    double depth = 0;
    for (const auto& [at, vertex] : terrain_of(tile_glb(world, {level, 0, 0}, job)))
      depth = std::max(depth, vertex.top - vertex.low);
    const double error = tile_bounds(world, {level, 0, 0}, job).geometric_error;
    EXPECT_LT(depth, 3.6 * error);
    EXPECT_GT(depth, error);
  }
  std::size_t seen = 0, hidden = 0;
  for (const int level : {1, 2, 3}) {
    const std::int64_t middle = std::int64_t{1} << (level - 1);
    const Terrain coarse = terrain_of(tile_glb(world, {level, middle - 1, middle - 1}, job));
    for (int finer = level; finer <= level + 3; ++finer) {
      const std::int64_t beside = std::int64_t{1} << (finer - 1);
      for (std::int64_t y = beside - (std::int64_t{1} << (finer - level)); y < beside; ++y) {
        for (const auto& [at, vertex] : terrain_of(tile_glb(world, {finer, beside, y}, job))) {
          if (at.first != 0) continue;
          ++seen;
          hidden += is_hidden(vertex, coarse, 0, at.second, frame_of(world, {level, 0, 0}).spacing) ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(seen, 1000U);
  EXPECT_EQ(hidden, seen);
}

/// Samples of wide tiles are of the land alone, and lack detail. On the floor of the sea, detail is the greatest part of
/// the relief: the ground was up to 2 m above these boxes.
TEST(WorldBounds, HoldTheDetailOfLevelGround) {
  const char* floor = R"({"extent":32768,"layers":["terrain"],"origin":[-147498,-36638],)"
                      R"("relief":{"gullies":0.8,"hills":140,"land":0.24,"mountains":2300,"ridges":0.85}})";
  const World world = world_of_text(floor, 535);
  Job job = test_job();
  for (const TileKey& key : {TileKey{2, 1, 3}, TileKey{3, 0, 7}, TileKey{4, 15, 13}, TileKey{8, 243, 217}})
    expect_inside(world, 535, key, job);
}

/// Sides of valleys reach the farther the higher the land is. At the border of the first tile a valley is 600 m wide; in
/// the second one it cuts high land 1 km from a river in level land; the third one has the slopes of a valley in a plateau,
/// which the samples of the box above lack. Skirts were 45, 25 and 8 m below their boxes.
TEST(WorldBounds, HoldSkirtsInWideValleys) {
  const World wide = world_of_text(
      R"({"origin":[340643,596072],"relief":{"continents":268008.41949241236,"gullies":0.55,"hills":188,)"
      R"("land":0.815,"mountains":684,"ridges":0.988},"water":{"rivers":0.0575,"width":106}})",
      505);
  const World beside_hills = world_of_text(
      R"({"origin":[267524,68150],"relief":{"continents":99214.58886806118,"hills":41.35,"mountains":2367,)"
      R"("ridges":0.669},"water":{"rivers":0.7467,"width":97.26}})",
      149);
  const World plateau = world_of_text(
      R"({"layers":["terrain","water","roads"],"origin":[-939,-816602],"relief":{"continents":253854.8337386376,)"
      R"("gullies":0.893,"hills":1.225,"mountains":287.8,"ridges":0.652,"sea_level":-488.3},)"
      R"("water":{"rivers":0.818,"width":8.66}})",
      144);
  Job job = test_job();
  expect_inside(wide, 505, {8, 226, 246}, job);
  expect_inside(beside_hills, 149, {7, 26, 11}, job);
  expect_inside(plateau, 144, {9, 298, 76}, job);
}

/// Samples of wide tiles are of the land alone. The skirt of this tile, on a level sea floor with gullies, was below its
/// box.
TEST(WorldBounds, HoldSkirtsWhereGulliesAreTheOnlyRelief) {
  const World world = world_of_text(
      R"({"extent":32768,"origin":[167894,466369],"relief":{"mountains":1,"hills":1,"gullies":1,"sea_level":250,)"
      R"("ridges":0,"land":0},"settlements":{"density":0}})",
      375798);
  Job job = test_job();
  for (std::int64_t k = 0; k < 64; ++k) {
    const TileKey key{3, k % 8, k / 8};
    const ContentBox content = content_of(tile_glb(world, key, job));
    EXPECT_GE(content.low[2], tile_bounds(world, key, job).low) << key.x << " " << key.y;
  }
}

TEST(WorldBounds, LeaveOutTheSeaWhereTilesDoNotShowIt) {
  const char* deep =
      R"({"extent":32768,"relief":{"sea_level":250,"land":0,"mountains":0},"layers":["terrain"]})";
  const char* wet =
      R"({"extent":32768,"relief":{"sea_level":250,"land":0,"mountains":0},"layers":["terrain","water"]})";
  Job job = test_job();
  const TileKey leaf{9, 200, 300};
  const World dry = world_of_text(deep, 7);
  const TileBounds box = tile_bounds(dry, leaf, job),
                   with_sea = tile_bounds(world_of_text(wet, 7), leaf, job);
  EXPECT_NEAR(with_sea.high, 250, 0.25);
  EXPECT_LT(box.high, 150);
  EXPECT_GE(box.high, content_of(tile_glb(dry, leaf, job)).high[2]);
}

/// Trees of 40 m that are rare, in level country. Boxes of leaves without one allow for no tree.
TEST(WorldBounds, AreLowWhereARareClassHasNoPlant) {
  const World world = world_of_text(
      R"({"extent":32768,"relief":{"land":1,"mountains":0,"hills":20},"settlements":{"density":0},"plants":)"
      R"([{"class":"giant","height":40,"spacing":60,"density":0.02,"moisture":[0,1],"temperature":[-60,60]}]})",
      7);
  Job job = test_job();
  int low = 0, tall = 0;
  for (std::int64_t k = 0; k < 400; ++k) {
    const TileKey leaf{9, 100 + k % 20, 300 + k / 20};
    const ContentBox content = content_of(tile_glb(world, leaf, job));
    const TileBounds box = tile_bounds(world, leaf, job);
    EXPECT_GE(box.high, content.high[2]);
    tall += content.high[2] - content.low[2] > 25 ? 1 : 0;
    low += box.high - box.low < 25 ? 1 : 0;
  }
  EXPECT_GT(tall, 0);
  EXPECT_GT(low, 250);
}

/// A class that grows in some heights or biomes alone.
TEST(WorldBounds, AllowForPlantsByHeightsAndBiomes) {
  const auto tallest_box = [](const char* rule) {
    const World world = world_of_text(
        (std::string(R"({"extent":32768,"relief":{"land":1,"mountains":0,"hills":20},"climate":)") +
         R"({"temperature":15,"moisture":0.6,"variation":0},"settlements":{"density":0},"plants":)" +
         R"([{"class":"tree","height":40,"spacing":4,"density":1,)" + rule + "}]}")
            .c_str(),
        7);
    Job job = test_job();
    const TileBounds box = tile_bounds(world, {9, 100, 300}, job);
    return box.high - box.low;
  };
  EXPECT_GT(tallest_box(R"("biomes":["forest"])"), 50);
  EXPECT_LT(tallest_box(R"("biomes":["desert","taiga"])"), 25);
  EXPECT_GT(tallest_box(R"("heights":[0,1000])"), 50);
  EXPECT_LT(tallest_box(R"("heights":[1500,2000])"), 25);
  EXPECT_LT(tallest_box(R"("heights":[-1000,-500])"), 25);
}

}  // namespace
}  // namespace seedmesh::world
