#include "core/geom/mesh/finish.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/rng.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Job job_of() { return Job(1, Job::Options{}); }

Mesh triangle(const Job& job, float size = 1) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, 3, glm::vec3(-0.0F, 0, 1));
  for (const glm::vec3 p : {glm::vec3{0, 0, 0}, {size, 0, -0.0F}, {0, size, 0}}) mesh.position.push_back(p);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (std::uint32_t i : {0U, 1U, 2U}) mesh.index.wide.push_back(i);
  return mesh;
}

/// A sheet of cells x cells squares whose triangles come in no order at all.
Mesh shuffled_sheet(const Job& job, std::uint32_t cells) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  for (std::uint32_t y = 0; y <= cells; ++y) {
    for (std::uint32_t x = 0; x <= cells; ++x) {
      mesh.position.push_back({x, y, 0});
      mesh.normal.push_back({0, 0, 1});
    }
  }
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
      faces.push_back({a, a + 1, b});
      faces.push_back({a + 1, b + 1, b});
    }
  }
  Rng rng(4);
  for (std::size_t i = faces.size() - 1; i > 0; --i)
    std::swap(faces[i], faces[rng.below(static_cast<std::uint32_t>(i + 1))]);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const auto& face : faces) mesh.index.wide.append(face);
  return mesh;
}

void add_node(Model& model, const std::string& name, Mesh mesh) {
  model.meshes.push_back({name, {}});
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  Node node;
  node.name = name;
  node.mesh = static_cast<int>(model.meshes.size()) - 1;
  model.nodes.push_back(std::move(node));
}

TEST(Finish, OrdersTrianglesForTheVertexCache) {
  Job job = job_of();
  Model model;
  add_node(model, "sheet", shuffled_sheet(job, 60));
  const double area = measure({&model.meshes[0].primitives[0].mesh}).area;
  finish(model, job);
  const MeshMeasures m = measure({&model.meshes[0].primitives[0].mesh});
  EXPECT_LT(m.cache_misses_a_vertex, 1.35);
  EXPECT_DOUBLE_EQ(m.area, area);
  EXPECT_THAT(faults(model), IsEmpty());
}

TEST(Finish, LeavesAnOrderThatItsMakerChose) {
  Job job = job_of();
  Model model;
  add_node(model, "sheet", shuffled_sheet(job, 10));
  Mesh& mesh = model.meshes[0].primitives[0].mesh;
  mesh.cache_ordered = true;
  const std::vector<std::uint32_t> before(mesh.index.wide.begin(), mesh.index.wide.end());
  finish(model, job);
  EXPECT_TRUE(
      std::equal(before.begin(), before.end(), model.meshes[0].primitives[0].mesh.index.small.begin()));
}

TEST(Finish, NarrowsIndicesAndSetsBounds) {
  Job job = job_of();
  Model model;
  add_node(model, "leaf", triangle(job, 3));
  finish(model, job);
  const Mesh& mesh = model.meshes[0].primitives[0].mesh;
  EXPECT_THAT(mesh.index.small, ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.index.wide, IsEmpty());
  EXPECT_EQ(mesh.bounds.min, glm::vec3(0, 0, 0));
  EXPECT_EQ(mesh.bounds.max, glm::vec3(3, 3, 0));
}

TEST(Finish, ReplacesNegativeZeros) {
  Job job = job_of();
  Model model;
  add_node(model, "leaf", triangle(job));
  EXPECT_EQ(measure({&model.meshes[0].primitives[0].mesh}).negative_zeros, 4U);
  finish(model, job);
  EXPECT_EQ(measure({&model.meshes[0].primitives[0].mesh}).negative_zeros, 0U);
}

TEST(Finish, BelievesAMakerThatHasWrittenNone) {
  Job job = job_of();
  Model model;
  add_node(model, "leaf", triangle(job));
  Mesh& mesh = model.meshes[0].primitives[0].mesh;
  mesh.no_minus_zero = true;
  finish(model, job);
  EXPECT_EQ(measure({&model.meshes[0].primitives[0].mesh}).negative_zeros, 4U);
  EXPECT_EQ(model.meshes[0].primitives[0].mesh.bounds.max.x, 1);
}

TEST(Finish, ChecksEveryPartOfLargeMeshes) {
  Model models[2];
  for (int i = 0; i < 2; ++i) {
    Job job(1, {.threads = 1 + 7 * i});
    add_node(models[i], "sheet", shuffled_sheet(job, 240));
    for (glm::vec2& uv : models[i].meshes[0].primitives[0].mesh.uv[0]) uv.x = -0.0F;
    finish(models[i], job);
  }
  const Mesh &one = models[0].meshes[0].primitives[0].mesh, &other = models[1].meshes[0].primitives[0].mesh;
  EXPECT_EQ(measure({&one}).negative_zeros, 0U);
  EXPECT_EQ(one.bounds.min, bounds_of(one.position.span()).min);
  EXPECT_EQ(one.bounds.max, bounds_of(one.position.span()).max);
  EXPECT_GT(one.index.small.size(), 300'000U);
  EXPECT_TRUE(one.index.wide.empty());
  EXPECT_TRUE(std::equal(one.index.small.begin(), one.index.small.end(), other.index.small.begin(),
                         other.index.small.end()));
}

TEST(Finish, DropsEmptyMeshesAndKeepsReferencesRight) {
  Job job = job_of();
  Model model;
  add_node(model, "nothing", Mesh());
  add_node(model, "leaf", triangle(job));
  model.nodes[1].lods = {0, 1};
  model.nodes[0].lods = {1};
  finish(model, job);
  ASSERT_THAT(model.meshes, SizeIs(1));
  EXPECT_EQ(model.nodes[0].mesh, 0);
  EXPECT_THAT(model.nodes[0].lods, IsEmpty());
  EXPECT_EQ(model.nodes[1].mesh, 0);
  EXPECT_THAT(model.nodes[1].lods, ElementsAre(0));
}

TEST(Finish, GivesEveryNameOnce) {
  Job job = job_of();
  Model model;
  for (const char* name : {"leaf", "leaf", "", "leaf_2", "leaf"}) add_node(model, name, triangle(job));
  model.materials.resize(2);
  finish(model, job);
  std::vector<std::string> names;
  for (const Node& node : model.nodes) names.push_back(node.name);
  EXPECT_THAT(names, ElementsAre("leaf", "leaf_2", "node", "leaf_2_2", "leaf_3"));
  EXPECT_EQ(model.materials[0].name, "material");
  EXPECT_EQ(model.materials[1].name, "material_2");
}

TEST(Finish, KeepsNamesFromMeaningSomethingElseToAnEngine) {
  Job job = job_of();
  Model model;
  for (const char* name : {"tree_col", "x-ConvColOnly", "protocol", "wall$noimp"})
    add_node(model, name, triangle(job));
  finish(model, job);
  std::vector<std::string> names;
  for (const Node& node : model.nodes) names.push_back(node.name);
  EXPECT_THAT(names, ElementsAre("tree_col_part", "x-ConvColOnly_part", "protocol", "wall$noimp_part"));
}

}  // namespace
}  // namespace seedmesh
