#include "core/geom/mesh/copies.h"

#include <gtest/gtest.h>

#include "core/geom/mesh/finish.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

/// A cube with a face for each side, from -half to half.
Mesh cube(const Job& job, float half) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(mesh.position.size());
      glm::vec3 n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;
      for (const glm::vec2 corner :
           {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.position.push_back((n + corner.x * u + corner.y * v) * half);
        mesh.normal.push_back(n);
      }
      for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(first + i);
    }
  }
  return mesh;
}

/// A frame that stands alone, and a window that three nodes show, one of them mirrored and one of them twice.
Model house(const Job& job) {
  Model model;
  model.materials.resize(2);
  model.meshes.push_back({"frame", {}});
  model.meshes.back().primitives.push_back({cube(job, 5), 0, {}});
  model.meshes.push_back({"window", {}});
  model.meshes.back().primitives.push_back({cube(job, 1), 1, {}});
  for (const int mesh : {0, 1, 1}) {
    Node node;
    node.name = "node";
    node.mesh = mesh;
    node.parent = model.nodes.empty() ? -1 : 0;
    model.nodes.push_back(std::move(node));
  }
  model.nodes[1].transform.scale = {-1, 1, 2};
  model.nodes[1].transform.translation = {10, 0, 0};
  model.nodes[2].transform.translation = {0, 20, 0};
  model.nodes[2].instances.transforms.resize(2);
  model.nodes[2].instances.transforms[1].translation = {0, 5, 0};
  return model;
}

TEST(Copies, AreCountedAsTheyAreShown) {
  EXPECT_EQ(count_copies(house(Job(1, Job::Options{}))), 3U);
  EXPECT_EQ(count_copies(Model{}), 0U);
}

TEST(Copies, BecomeOneMeshThatIsSound) {
  Job job(1, Job::Options{});
  Model model = house(job);
  const Box before = bounds_of(model);
  const ModelCounts counts = count(model);
  merge_copies(model, job);
  finish(model, job);
  EXPECT_EQ(model.nodes.size(), 2U);  // the frame, and the copies
  EXPECT_EQ(model.nodes[1].name, "copies");
  EXPECT_EQ(model.nodes[1].parent, 0);
  EXPECT_EQ(count(model).triangles, counts.triangles);
  const Box after = bounds_of(model);
  EXPECT_EQ(before.min, after.min);
  EXPECT_EQ(before.max, after.max);
  EXPECT_TRUE(faults(model).empty()) << faults(model).front();
  EXPECT_EQ(job.spent(Resource::triangles), 12U);  // one copy more than there were meshes in nodes
}

TEST(Copies, KeepTheirCoarserLevels) {
  Job job(1, Job::Options{});
  Model model = house(job);
  model.meshes.push_back({"window_LOD1", {}});
  model.meshes.back().primitives.push_back({cube(job, 0.5F), 1, {}});
  model.nodes[1].lods = {2};
  merge_copies(model, job);
  const Node& all = model.nodes.back();
  ASSERT_EQ(all.lods.size(), 1U);
  EXPECT_EQ(model.meshes[static_cast<std::size_t>(all.lods[0])].primitives[0].mesh.elements(), 36U);
}

TEST(Copies, LeaveWhatMoves) {
  Job job(1, Job::Options{});
  Model model = house(job);
  model.animations.push_back(
      {"swing", {{0, 1}}, {{1, Path::translation, Interpolation::linear, 0, {0, 0, 0, 1, 1, 1}}}});
  merge_copies(model, job);
  EXPECT_EQ(model.nodes[1].mesh, 1);
  EXPECT_FALSE(model.meshes[1].primitives.empty());
  EXPECT_EQ(model.animations[0].channels[0].node, 1);
}

}  // namespace
}  // namespace seedmesh
