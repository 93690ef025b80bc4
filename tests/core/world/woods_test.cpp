/// Woods by level: plants of lower shares, and the surface of crowns.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/math.h"
#include "core/generators/world/canopy.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/store.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

TEST(WorldWoods, OfALowerShareAreAPartOfThoseOfAHigherOne) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::size_t all = 0, most = 0, few = 0;
  for (int k = 0; k < 60; ++k) {
    const double east = 256.0 * (251 * k % 700), north = 256.0 * (97 * k % 700);
    const Rectangle box{east, north, east + 128, north + 128};
    const Ground ground(world, box, job);
    std::set<std::pair<double, double>> below;
    for (const Plant& p : plants_in(world, 0, box, ground, job)) below.insert({p.east, p.north});
    all += below.size();
    for (const double share : {0.25, 0.08}) {
      std::set<std::pair<double, double>> own;
      for (const Plant& p : plants_in(world, 0, box, ground, job, {share})) {
        EXPECT_TRUE(below.contains({p.east, p.north}));
        own.insert({p.east, p.north});
      }
      (share == 0.25 ? most : few) += own.size();
      below = std::move(own);
    }
  }
  ASSERT_GT(all, 2000U);
  EXPECT_NEAR(static_cast<double>(most) / static_cast<double>(all), 0.7, 0.12);
  EXPECT_NEAR(static_cast<double>(few) / static_cast<double>(all), 0.4, 0.1);
}

/// The images of plants and of the ground depend on nothing of a request.
TEST(WorldWoods, HaveImagesThatAllWorldsOfAStoreShare) {
  const auto store = std::make_shared<Store>();
  const Result<World> seven = read_world(mountains_with_woods(), 7, store),
                      eight = read_world(mountains_with_woods(), 8, store);
  ASSERT_TRUE(seven && eight);
  Job job = test_job();
  for (const auto image : {+[](const World&w, Job&j) { return canopy_texture(w, j); },
                           +[](const World&w, Job&j) { return leaf_texture(w, j); },
                           +[](const World&w, Job&j) { return ground_texture(w, GroundKind::grass, j); }}) {
    const auto first = image(*seven, job);
    const std::uint64_t bytes = store->bytes();
    EXPECT_EQ(image(*eight, job), first);
    EXPECT_EQ(store->bytes(), bytes);
  }
}

struct Surface {
  std::set<std::array<std::int64_t, 3>> border;  ///< east and up in steps, at the given border
  std::size_t vertices = 0;
};

/// The surface of woods of a tile, with its vertices at the east or west border.
Surface surface_of(const std::string& glb, bool at_east, double half) {
  const GlbParts parts = parts_of(glb);
  Surface found;
  for (const Json& node : parts.json["nodes"]) {
    if (node["name"] != "plants") continue;
    const double step = node["scale"][0], height = node["translation"][1];
    const Json& attributes = parts.json["meshes"][node["mesh"].get<int>()]["primitives"][0]["attributes"];
    EXPECT_TRUE(attributes.contains("TEXCOORD_0"));
    const Json& accessor = parts.json["accessors"][attributes["POSITION"].get<int>()];
    const Json& view = parts.json["bufferViews"][accessor["bufferView"].get<int>()];
    const char* from = parts.bytes.data() + view.value("byteOffset", 0);
    found.vertices = accessor["count"].get<std::size_t>();
    for (std::size_t k = 0; k < found.vertices; ++k) {
      std::int16_t p[3];
      std::memcpy(p, from + 16 * k, 6);
      EXPECT_LE(std::abs(p[0] * step), half);
      EXPECT_LE(std::abs(p[2] * step), half);
      if (p[0] * step == (at_east ? half : -half))
        found.border.insert({p[2], math::to_int64(std::floor((height + step * p[1]) / step + 0.5)), 0});
    }
  }
  return found;
}

TEST(WorldWoods, HaveASurfaceThatMeetsThatOfTheNextTile) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::size_t shared = 0, same = 0, vertices = 0;
  for (int k = 0; k < 12; ++k) {
    for (const int above : {3, 5, 7}) {
      const int level = world.levels - 1 - above;
      const std::int64_t side = std::int64_t{1} << level;
      const TileKey key{level, side / 2 + 13 * k, side / 2 - 7 * k}, next{level, key.x + 1, key.y};
      const double half = frame_of(world, key).side / 2;
      const Surface west = surface_of(tile_glb(world, key, job), true, half),
                    east = surface_of(tile_glb(world, next, job), false, half);
      vertices += west.vertices;
      shared += west.border.size();
      for (const auto& place : west.border) same += east.border.contains(place) ? 1 : 0;
    }
  }
  EXPECT_GT(vertices, 2000U);
  ASSERT_GT(shared, 100U);
  // at edges of woods, what lies beyond the border moves a vertex along it
  EXPECT_GT(static_cast<double>(same), 0.9 * static_cast<double>(shared));
}

}  // namespace
}  // namespace seedmesh::world
