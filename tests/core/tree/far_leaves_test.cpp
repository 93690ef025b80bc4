#include "core/generators/tree/far_leaves.h"

#include <gtest/gtest.h>

#include "core/generators/tree/leaves.h"
#include "core/generators/tree/tree.h"
#include "core/geom/mesh/finish.h"
#include "core/model/levels.h"
#include "tests/core/tree/support.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::tree {
namespace {

TreeParams twigs(TreeBuild build = TreeBuild::twig) {
  TreeParams params;
  params.branches_1 = 30;
  params.branches_2 = 24;
  params.Leaves = 12;
  params.leaf.build = build;
  params.leaf.coarseness = 3;
  return params;
}

std::uint64_t triangles_at(const Model& model, std::size_t level) {
  std::uint64_t sum = 0;
  for (const Node& node : model.nodes) {
    const int mesh = level == 0 ? node.mesh : level - 1 < node.lods.size() ? node.lods[level - 1] : -1;
    if (mesh < 0) continue;
    for (const Primitive& each : model.meshes[static_cast<std::size_t>(mesh)].primitives)
      sum += each.mesh.elements();
  }
  return sum;
}

Model made(const TreeParams& params, const Demand& demand) {
  Job job(5, Job::Options{});
  Result<Model> model = generate(params, {job, demand});
  EXPECT_TRUE(model);
  finish(*model, job);
  return std::move(*model);
}

/// The position that a triangle gives to texture coordinates.
glm::dvec3 point_at(const Mesh& mesh, std::size_t first, const glm::dvec2& uv) {
  const auto corner = [&](std::size_t i) { return mesh.index.at(first + i); };
  const glm::dvec2 a(mesh.uv[0][corner(0)]), b = glm::dvec2(mesh.uv[0][corner(1)]) - a,
                                             c = glm::dvec2(mesh.uv[0][corner(2)]) - a, p = uv - a;
  const double whole = b.x * c.y - b.y * c.x, s = (p.x * c.y - p.y * c.x) / whole,
               t = (b.x * p.y - b.y * p.x) / whole;
  const glm::dvec3 from(mesh.position[corner(0)]), to_b = glm::dvec3(mesh.position[corner(1)]) - from,
                                                   to_c = glm::dvec3(mesh.position[corner(2)]) - from;
  return from + s * to_b + t * to_c;
}

TEST(FarLeaves, ShowTheTextureOfASquareAtItsPosition) {
  Job job(1, Job::Options{});
  for (const TreeBuild build : {TreeBuild::twig, TreeBuild::cross, TreeBuild::bunch}) {
    const TreeParams params = twigs(build);
    const Mesh squares = far_leaf(params, LeafDetail::square, 1, job),
               triangles = far_leaf(params, LeafDetail::triangle, 1, job);
    ASSERT_EQ(squares.elements(), 2 * triangles.elements());
    for (std::size_t i = 0; i < squares.position.size(); ++i) {
      const glm::dvec3 shown = point_at(triangles, i / 4 * 3, glm::dvec2(squares.uv[0][i]));
      EXPECT_LT(glm::distance(shown, glm::dvec3(squares.position[i])), 1e-5) << text_of(build) << ' ' << i;
    }
    EXPECT_NEAR(measure({&triangles}).area / measure({&squares}).area, 1.2, 0.001);
  }
  EXPECT_EQ(far_leaf(twigs(TreeBuild::cross), LeafDetail::one_card, 1, job).elements(), 1U);
}

/// The triangles of the first level within the budget, or of the coarsest one.
std::uint64_t first_within(const Model& model, std::uint64_t budget) {
  std::size_t level = 0;
  while (level + 1 < levels_of(model) && triangles_at(model, level) > budget) ++level;
  return triangles_at(model, level);
}

TEST(FarLeaves, LeaveOutTheLevelsThatABudgetDoesNotShow) {
  for (const char* preset : {"oak", "weeping_willow", "black_oak", "pine"}) {
    const TreeParams params = parameters_of_preset(preset);
    const Demand all{.lods = 5, .textures = 0};
    const Model whole = made(params, all);
    const std::uint64_t finest = triangles_at(whole, 0);
    for (const std::uint64_t budget : {2 * finest, finest / 2, finest / 4, finest / 10, finest / 100}) {
      Demand one = all;
      one.most_triangles = budget;
      one.first_fit = true;
      const Model fewer = made(params, one);
      EXPECT_EQ(first_within(fewer, budget), first_within(whole, budget)) << preset << ' ' << budget;
      EXPECT_LT(fewer.meshes.size(), whole.meshes.size()) << preset << ' ' << budget;
    }
  }
}

TEST(FarLeaves, FaceAwayFromTheTrunkWhereOneFaceShowsBothSides) {
  const Model model = made(twigs(), {.lods = 4, .textures = 64});
  const Mesh& mesh =
      model.meshes[static_cast<std::size_t>(model.nodes.back().lods.back())].primitives.front().mesh;
  const Material& material = model.materials[static_cast<std::size_t>(
      model.meshes[static_cast<std::size_t>(model.nodes.back().lods.back())].primitives.front().material)];
  EXPECT_TRUE(material.double_sided);
  std::size_t outward = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::vec3 &a = mesh.position[mesh.index.at(i)], &b = mesh.position[mesh.index.at(i + 1)],
                    &c = mesh.position[mesh.index.at(i + 2)];
    const glm::vec3 face = glm::cross(b - a, c - a), at = (a + b + c) / 3.0F;
    outward += face.x * at.x + face.z * at.z > 0 ? 1U : 0U;
  }
  EXPECT_GT(outward, mesh.elements() * 9 / 10);
}

TEST(FarLeaves, GiveLevelsTheirSharesOfTheTriangles) {
  for (const TreeBuild build : {TreeBuild::twig, TreeBuild::cross}) {
    const Model model = made(twigs(build), {.lods = 4, .textures = 64});
    EXPECT_TRUE(faults(model).empty());
    const auto whole = static_cast<double>(triangles_at(model, 0));
    EXPECT_LE(static_cast<double>(triangles_at(model, 1)), 0.41 * whole);
    EXPECT_LE(static_cast<double>(triangles_at(model, 2)), 0.155 * whole);
    EXPECT_LE(static_cast<double>(triangles_at(model, 3)), 0.055 * whole);
  }
}

TEST(FarLeaves, ArePlainSquaresWithoutTextures) {
  const Model model = made(twigs(), {.lods = 4, .textures = 0});
  EXPECT_GT(static_cast<double>(triangles_at(model, 3)), 0.15 * static_cast<double>(triangles_at(model, 0)));
}

}  // namespace
}  // namespace seedmesh::tree
