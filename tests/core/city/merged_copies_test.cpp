#include "core/generators/city/merged_copies.h"

#include <gtest/gtest.h>

#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

Mesh triangle(const Job& job, float size) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const glm::vec3& p : {glm::vec3(0), glm::vec3(size, 0, 0), glm::vec3(0, size, 0)}) {
    mesh.position.push_back(p);
    mesh.normal.push_back({0, 0, 1});
  }
  for (const std::uint32_t corner : {0U, 1U, 2U}) mesh.index.wide.push_back(corner);
  return mesh;
}

int add_shown(Model& model, Mesh mesh, int material, int parent, const glm::vec3& shift) {
  Node node;
  node.name = "node";
  node.parent = parent;
  node.transform.translation = shift;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back({"mesh", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), material, {}});
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

/// A node below a node, both moved, with the same material; and a third one with another.
Model moved_nodes(const Job& job) {
  Model model;
  model.materials.resize(2);
  const int parent = add_shown(model, triangle(job, 1), 1, -1, {10, 0, 0});
  add_shown(model, triangle(job, 2), 1, parent, {0, 5, 0});
  add_shown(model, triangle(job, 4), 0, -1, {0, 0, 7});
  return model;
}

class MergedCopiesTest : public testing::Test {
 protected:
  /// The model of a city that shows the copies.
  Model written() {
    Model city;
    add_node(city, "city", -1);
    const CityPlan plan;
    const Chunks chunks(plan, CityParams());
    ChunkNodes nodes(city, chunks);
    copies.write(city, nodes, "buildings", "house");
    return city;
  }

  Job job{1, Job::Options{}};
  MergedCopies copies{job};
};

TEST_F(MergedCopiesTest, AddTheTranslationsOfParentNodesAndThatOfTheCopy) {
  Transform at;
  at.translation = {100, 0, 0};
  ASSERT_TRUE(copies.add_nodes(moved_nodes(job), {7, 3}, at, 0));
  const Model city = written();
  ASSERT_EQ(city.meshes.size(), 2U);  // one for each material
  const Primitive& two = city.meshes[0].primitives[0];
  EXPECT_EQ(two.material, 3);  // material 1 of the model
  ASSERT_EQ(two.mesh.position.size(), 6U);
  EXPECT_EQ(two.mesh.position[0], glm::vec3(110, 0, 0));
  EXPECT_EQ(two.mesh.position[3], glm::vec3(110, 5, 0));
  EXPECT_EQ(two.mesh.position[4], glm::vec3(112, 5, 0));
  EXPECT_EQ(two.mesh.index.wide[3], 3U);
  const Primitive& one = city.meshes[1].primitives[0];
  EXPECT_EQ(one.material, 7);
  EXPECT_EQ(one.mesh.position[0], glm::vec3(100, 0, 7));
}

TEST_F(MergedCopiesTest, TurnPositionsAndNormals) {
  Transform at;
  at.rotation = glm::quat(glm::vec3(0, glm::radians(90.0F), 0));
  copies.add(triangle(job, 1), 0, at, 0);
  const Model city = written();
  ASSERT_EQ(city.meshes.size(), 1U);
  const Mesh& mesh = city.meshes[0].primitives[0].mesh;
  EXPECT_NEAR(mesh.position[1].z, -1, 1e-6);  // x turns to -z about +Y
  EXPECT_NEAR(mesh.normal[0].x, 1, 1e-6);     // z turns to x
}

TEST_F(MergedCopiesTest, AddNothingOfAModelWithATurnedNode) {
  Model model = moved_nodes(job);
  model.nodes[1].transform.scale = {2, 1, 1};
  EXPECT_FALSE(copies.add_nodes(model, {0, 1}, {}, 0));
  EXPECT_TRUE(written().meshes.empty());
}

TEST_F(MergedCopiesTest, AddNothingOfAModelWithoutNormals) {
  Model model = moved_nodes(job);
  model.meshes[2].primitives[0].mesh.normal = {};
  EXPECT_FALSE(copies.add_nodes(model, {0, 1}, {}, 0));
  EXPECT_TRUE(written().meshes.empty());
}

TEST_F(MergedCopiesTest, BeginANewMeshBeforeIndicesNeedMoreThanSixteenBits) {
  for (int i = 0; i < 30'000; ++i) copies.add(triangle(job, 1), 0, {}, 0);
  const Model city = written();
  ASSERT_EQ(city.meshes.size(), 2U);
  std::size_t vertices = 0;
  for (const MeshGroup& each : city.meshes) {
    EXPECT_LE(each.primitives[0].mesh.position.size(), 65'535U);
    vertices += each.primitives[0].mesh.position.size();
  }
  EXPECT_EQ(vertices, 90'000U);
}

}  // namespace
}  // namespace seedmesh::city
