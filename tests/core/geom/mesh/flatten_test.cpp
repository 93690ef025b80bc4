/// Models as one mesh, and vertices that are equal as one vertex.
#include "core/geom/mesh/flatten.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geom/mesh/weld.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

Job any_job() { return Job(0, Job::Options{}); }

/// A tetrahedron with a normal for each face: the corner of a unit cube.
Mesh tetrahedron(const Job& job) {
  const glm::vec3 at[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const auto& face : faces) {
    const glm::vec3 normal = glm::normalize(glm::cross(at[face[1]] - at[face[0]], at[face[2]] - at[face[0]]));
    for (const int corner : face) {
      mesh.index.wide.push_back(static_cast<std::uint32_t>(mesh.position.size()));
      mesh.position.push_back(at[corner]);
      mesh.normal.push_back(normal);
    }
  }
  return mesh;
}

Model with_nodes(const Job& job, std::vector<Node> nodes) {
  Model model;
  model.materials.resize(1);
  model.meshes.emplace_back().primitives.push_back({tetrahedron(job), 0, {}});
  model.nodes = std::move(nodes);
  return model;
}

Node shown(glm::vec3 translation, glm::vec3 scale = glm::vec3(1)) {
  Node node;
  node.mesh = 0;
  node.transform.translation = translation;
  node.transform.scale = scale;
  return node;
}

TEST(Flatten, JoinsWhatNodesShowToOneMeshOfEachMaterial) {
  Job job = any_job();
  const auto parts = flatten(with_nodes(job, {shown({0, 0, 0}), shown({5, 0, 0}, glm::vec3(2))}), job);
  ASSERT_THAT(parts, SizeIs(1));
  const MeshMeasures mesh = measure({&parts[0].mesh});
  EXPECT_EQ(mesh.triangles, 8U);
  EXPECT_NEAR(mesh.volume, 1 / 6.0 + 8 / 6.0, 1e-6);
  EXPECT_THAT(faults(parts[0].mesh), IsEmpty());
}

TEST(Flatten, TurnsTrianglesRoundThatANodeMirrors) {
  Job job = any_job();
  const auto parts = flatten(with_nodes(job, {shown({0, 0, 0}, {-1, 1, 1})}), job);
  EXPECT_NEAR(measure({&parts[0].mesh}).volume, 1 / 6.0, 1e-6);
  EXPECT_THAT(faults(parts[0].mesh), IsEmpty());
}

TEST(Flatten, FollowsParentsAndCopiesAndCountsCopies) {
  Job job = any_job();
  Node parent;
  parent.transform.translation = {0, 10, 0};
  Node child = shown({1, 0, 0});
  child.parent = 0;
  child.instances.transforms = {{{0, 0, 0}, {1, 0, 0, 0}, glm::vec3(1)},
                                {{3, 0, 0}, {1, 0, 0, 0}, glm::vec3(1)}};
  const auto parts = flatten(with_nodes(job, {parent, child}), job);
  const Box box = bounds_of(parts[0].mesh.position.span());
  EXPECT_EQ(box.min, glm::vec3(1, 10, 0));
  EXPECT_EQ(box.max, glm::vec3(5, 11, 1));
  EXPECT_EQ(job.spent(Resource::triangles), 4U);  // the second copy
}

TEST(Flatten, FillsAttributesThatOnlySomePartsHave) {
  Job job = any_job();
  Model model = with_nodes(job, {shown({0, 0, 0}), shown({3, 0, 0})});
  model.meshes.emplace_back().primitives.push_back({tetrahedron(job), 0, {}});
  Mesh& tinted = model.meshes[1].primitives[0].mesh;
  tinted.color = Array<glm::u8vec4>(job, tinted.position.size(), glm::u8vec4(1, 2, 3, 255));
  model.nodes[1].mesh = 1;
  const auto parts = flatten(model, job);
  ASSERT_EQ(parts[0].mesh.color.size(), parts[0].mesh.position.size());
  EXPECT_EQ(parts[0].mesh.color[0], glm::u8vec4(255));
  EXPECT_EQ(parts[0].mesh.color.back(), glm::u8vec4(1, 2, 3, 255));
}

TEST(UnitBox, EnclosesAllPrimitivesWithItsLongestSideAsOne) {
  Job job = any_job();
  auto parts = flatten(with_nodes(job, {shown({7, 0, 0}, {4, 1, 1})}), job);
  ASSERT_TRUE(fit_unit_box(parts));
  const Box box = bounds_of(parts[0].mesh.position.span());
  EXPECT_EQ(box.min, glm::vec3(-0.5F, -0.125F, -0.125F));
  EXPECT_EQ(box.max, glm::vec3(0.5F, 0.125F, 0.125F));
  std::vector<Primitive> nothing;
  EXPECT_FALSE(fit_unit_box(nothing));
}

TEST(Weld, MakesOneVertexOfEqualOnesAndLeavesOthers) {
  Job job = any_job();
  Mesh mesh = tetrahedron(job);
  weld(mesh, job);
  EXPECT_EQ(mesh.position.size(), 12U);  // a corner has three normals
  for (glm::vec3& normal : mesh.normal) normal = {0, 1, 0};
  weld(mesh, job);
  EXPECT_EQ(mesh.position.size(), 4U);
  EXPECT_EQ(mesh.index.size(), 12U);
  EXPECT_NEAR(measure({&mesh}).volume, 1 / 6.0, 1e-6);
}

TEST(Weld, TakesMinusZeroForZero) {
  Job job = any_job();
  Mesh mesh = tetrahedron(job);
  for (glm::vec3& normal : mesh.normal) normal = {0, 1, 0};
  mesh.position[3].x = -0.0F;
  weld(mesh, job);
  EXPECT_EQ(mesh.position.size(), 4U);
}

}  // namespace
}  // namespace seedmesh
