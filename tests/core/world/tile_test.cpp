/// Tiles: borders, samples that levels share, boxes, errors, worlds with a moved origin.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

/// Tiles on a path from the root to a leaf.
std::vector<TileKey> path_to(const World& world, std::int64_t x, std::int64_t y) {
  std::vector<TileKey> path;
  for (int level = 3; level < world.levels; ++level) {
    const int below = world.levels - 1 - level;
    path.push_back({level, x >> below, y >> below});
  }
  return path;
}

TEST(WorldTiles, MeetToTheBit) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  for (const TileKey& key : path_to(world, 8191, 5000)) {
    const Terrain west = terrain_of(tile_glb(world, key, job));
    const Terrain east = terrain_of(tile_glb(world, {key.level, key.x + 1, key.y}, job));
    const TileFrame frame = frame_of(world, key);
    int shared = 0;
    for (const auto& [at, vertex] : west) {
      if (at.first != frame.west + frame.side) continue;
      const auto twin = east.find(at);
      ASSERT_NE(twin, east.end());
      EXPECT_EQ(vertex.top, twin->second.top);
      EXPECT_EQ(vertex.normal, twin->second.normal);
      ++shared;
    }
    EXPECT_EQ(shared, frame_of(world, key).cells + 1) << "level " << key.level;
  }
}

TEST(WorldTiles, ShareSamplesWithTheLevelAbove) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  int shared = 0;
  for (const TileKey& key : path_to(world, 9001, 7003)) {
    const Terrain fine = terrain_of(tile_glb(world, key, job));
    const TileKey above{key.level - 1, key.x / 2, key.y / 2};
    const double most = (frame_of(world, key).step + frame_of(world, above).step) / 2;
    for (const auto& [at, vertex] : terrain_of(tile_glb(world, above, job))) {
      const auto twin = fine.find(at);
      if (twin == fine.end()) continue;
      EXPECT_LE(std::abs(vertex.top - twin->second.top), most);
      ++shared;
    }
  }
  EXPECT_EQ(shared, 11 * 17 * 17 + 33 * 33) << "tiles of 4 km have the spacing of those above";
}

TEST(WorldTiles, LieInTheirBoxesAndThoseInTheBoxesAbove) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  for (const std::int64_t x : {3000, 8192, 12345}) {
    TileBounds above = tile_bounds(world, {0, 0, 0}, job);
    for (int level = 1; level < world.levels; ++level) {
      const TileKey key{level, x >> (14 - level), (x / 2 + 77) >> (14 - level)};
      const TileBounds box = tile_bounds(world, key, job);
      for (const auto& [at, vertex] : terrain_of(tile_glb(world, key, job))) {
        ASSERT_GE(vertex.low, box.low) << "level " << level;
        ASSERT_LE(vertex.top, box.high) << "level " << level;
      }
      EXPECT_GE(box.low, above.low);
      EXPECT_LE(box.high, above.high);
      EXPECT_GE(box.west, above.west);
      EXPECT_LE(box.north, above.north);
      EXPECT_LT(box.geometric_error, above.geometric_error);
      EXPECT_LE(box.geometric_error, greatest_error(world) / static_cast<double>(1 << level));
      above = box;
    }
    EXPECT_EQ(above.geometric_error, 0);
  }
}

/// The vertical distance of the finer samples from the coarser triangles bounds their distance.
TEST(WorldTiles, DeclareTheErrorThatTheyHave) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  for (int level = 5; level + 1 < world.levels; ++level) {
    const TileKey key{level, std::int64_t{9700} >> (14 - level), std::int64_t{6100} >> (14 - level)};
    const Terrain coarse = terrain_of(tile_glb(world, key, job));
    const double spacing = frame_of(world, key).spacing;
    if (frame_of(world, {level + 1, 0, 0}).spacing == spacing) continue;
    double most = 0;
    for (const auto& [at, vertex] : terrain_of(tile_glb(world, {level + 1, 2 * key.x, 2 * key.y}, job))) {
      const double x = std::floor(at.first / spacing) * spacing,
                   y = std::floor(at.second / spacing) * spacing;
      const bool right = at.first > x, up = at.second > y;
      if (!right && !up) continue;
      if (std::fmod(at.first, spacing / 2) != 0 || std::fmod(at.second, spacing / 2) != 0) continue;
      // the middle of an edge, or of the diagonal from the south-west to the north-east
      const auto a = coarse.find({x, y}), b = coarse.find({right ? x + spacing : x, up ? y + spacing : y});
      if (a == coarse.end() || b == coarse.end()) continue;
      most = std::max(most, std::abs(vertex.top - (a->second.top + b->second.top) / 2));
    }
    EXPECT_GT(most, 0);
    EXPECT_LE(most, 1.3 * tile_bounds(world, key, job).geometric_error) << "level " << level;
  }
}

TEST(WorldTiles, HaveTheSameBuffersInAWorldWithMovedOrigin) {
  WorldParams params = mountains_with_woods();
  const World here = world_of(params);
  params.origin = {3, -2};
  const World there = world_of(params);
  Job job = test_job();
  int same = 0;
  for (int level = 5; level < here.levels; ++level) {
    const std::int64_t regions = std::int64_t{1} << (level - 5);
    const TileKey a{level, 17 * regions + regions / 3, 14 * regions + regions / 2};
    const TileKey b{level, a.x - 3 * regions, a.y + 2 * regions};
    const GlbParts first = parts_of(tile_glb(here, a, job)), second = parts_of(tile_glb(there, b, job));
    EXPECT_EQ(first.bytes, second.bytes) << "level " << level;
    same += first.json == second.json ? 1 : 0;
  }
  EXPECT_EQ(same, 0) << "the translations differ";
}

TEST(WorldTiles, DifferByTheSeed) {
  const World seven = world_of(mountains_with_woods()), eight = world_of(mountains_with_woods(), 8);
  Job job = test_job();
  EXPECT_NE(parts_of(tile_glb(seven, {8, 100, 120}, job)).bytes,
            parts_of(tile_glb(eight, {8, 100, 120}, job)).bytes);
}

/// The triangles of tiles with one kind of ground and the texture coordinates of all but wide ones are one file, which clients
/// load once.
TEST(WorldTiles, ShareOneFileOfTriangles) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::set<std::string> files;
  for (const TileKey& key : {TileKey{0, 0, 0}, TileKey{7, 60, 60}, TileKey{14, 8000, 8000}}) {
    const Json json = parts_of(tile_glb(world, key, job)).json;
    const Json& mesh = json["meshes"][json["nodes"][1]["mesh"].get<int>()]["primitives"][0];
    std::vector<Json> shared;
    if (json["meshes"][json["nodes"][1]["mesh"].get<int>()]["primitives"].size() == 1)
      shared.push_back(mesh["indices"]);
    if (mesh["attributes"].contains("TEXCOORD_0")) shared.push_back(mesh["attributes"]["TEXCOORD_0"]);
    EXPECT_GE(shared.size(), key.level == 7 ? 2U : 1U) << "level " << key.level;
    for (const Json& accessor : shared) {
      const Json& view = json["bufferViews"][json["accessors"][accessor.get<int>()]["bufferView"].get<int>()];
      const Json& buffer = json["buffers"][view["buffer"].get<int>()];
      const std::string uri = buffer["uri"];
      files.insert(uri);
      const auto file = shared_file(world, uri.substr(uri.rfind('/') + 1, 16), job);
      ASSERT_TRUE(file);
      EXPECT_EQ(file->bytes.size(), buffer["byteLength"].get<std::size_t>());
      EXPECT_LE(view.value("byteOffset", 0U) + view["byteLength"].get<std::size_t>(), file->bytes.size());
    }
  }
  EXPECT_EQ(files.size(), 1U);
}

TEST(WorldTiles, ContainOnlyTheLayersThatAreAskedFor) {
  WorldParams params = mountains_with_woods();
  params.layers = {WorldLayersItem::water};
  const World world = world_of(params);
  Job job = test_job();
  const Json json = parts_of(tile_glb(world, {0, 0, 0}, job)).json;
  ASSERT_EQ(json["nodes"].size(), 2U);
  EXPECT_EQ(json["nodes"][1]["name"], "water");
}

}  // namespace
}  // namespace seedmesh::world
