/// Tiles of worlds: borders, shared samples, boxes, rivers.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

TEST(World, HasLeavesOf64Metres) {
  WorldParams params;
  const Result<World> world = read_world(params, 7);
  ASSERT_TRUE(world);
  EXPECT_EQ(world->levels, 15);
}

Model model_of(const WorldParams& params) {
  Job job(7, Job::Options{});
  Result<Model> model = generate(params, {job});
  EXPECT_TRUE(model);
  return *std::move(model);
}

/// The corners of the mesh of a node.
std::vector<glm::vec3> vertices_of(const Model& model, const std::string& name) {
  std::vector<glm::vec3> found;
  for (const Node& node : model.nodes) {
    if (node.name != name) continue;
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].mesh;
    for (const std::uint32_t k : mesh.index.wide) found.push_back(mesh.position[k]);
  }
  return found;
}

TEST(World, IsAModelWithTheSeaOfItsRootTile) {
  WorldParams params;
  params.relief.land = 0.4;
  const std::vector<glm::vec3> water = vertices_of(model_of(params), "water");
  ASSERT_EQ(water.size() % 6, 0U) << "squares of two triangles";
  EXPECT_GT(water.size() / 6, 50U);
  EXPECT_LE(water.size() / 6, 256U);
  float low = 0, high = 0;
  for (const glm::vec3& p : water) {
    low = std::min({low, p.x, p.z});
    high = std::max({high, p.x, p.z});
    EXPECT_NEAR(p.y, params.relief.sea_level, 16) << "half of the step of heights";
  }
  EXPECT_EQ(low, -524288);
  EXPECT_EQ(high, 524288);
}

TEST(World, IsAModelWithTheRiversOfASmallWorld) {
  WorldParams params;
  params.extent = 32768;
  params.relief.sea = false;
  params.relief.land = 1;
  params.water.rivers = 1;
  params.water.width = 60;
  EXPECT_GT(vertices_of(model_of(params), "water").size(), 100U);
  params.layers = {WorldLayersItem::terrain};
  EXPECT_TRUE(vertices_of(model_of(params), "water").empty());
  EXPECT_EQ(vertices_of(model_of(params), "terrain").size(), 6U * 32 * 32);
  params.layers = {WorldLayersItem::water};
  EXPECT_TRUE(vertices_of(model_of(params), "terrain").empty());
}

TEST(World, NamesNumbersOfARangeInTheWrongOrder) {
  WorldParams params;
  WorldClass tree;
  tree.class_name = "tree";
  tree.moisture = {0.75, 0.25};
  params.plants = {tree};
  const Result<World> world = read_world(params, 1);
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().issues.front().pointer, "/plants/0/moisture");
  EXPECT_EQ(world.error().issues.front().message, "found 0.75 before 0.25, expected the lower number first");
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
