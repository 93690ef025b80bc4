/// Tiles of worlds: borders, shared samples, boxes, rivers.
#include <gtest/gtest.h>

#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

TEST(World, HasLeavesOf64Metres) {
  WorldParams params;
  const Result<World> world = read_world(params, 7);
  ASSERT_TRUE(world);
  EXPECT_EQ(world->levels, 15);
  EXPECT_TRUE(has_tile(*world, {14, 16383, 0}));
  EXPECT_FALSE(has_tile(*world, {15, 0, 0}));
  EXPECT_FALSE(has_tile(*world, {3, 8, 0}));
}

TEST(World, RefusesAnExtentThatIsNoPowerOfTwo) {
  WorldParams params;
  params.extent = 1000000;
  const Result<World> world = read_world(params, 7);
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().issues.front().pointer, "/extent");
}

}  // namespace
}  // namespace seedmesh::world
