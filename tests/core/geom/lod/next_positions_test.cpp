#include "core/geom/lod/next_positions.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "core/base/rng.h"
#include "core/geom/lod/thin.h"

namespace seedmesh {
namespace {

Mesh empty_mesh(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

/// A leaf: a square of this size at a stalk, with `rows` rows.
struct Leaf {
  glm::vec3 stalk{0};
  glm::quat turn{1, 0, 0, 0};
  float size = 1;

  glm::vec3 at(const glm::vec2& uv) const {
    return stalk + size * (turn * glm::vec3(uv.x - 0.5F, 1 - uv.y, 0));
  }
};

void add(Mesh& mesh, const Leaf& leaf, std::uint32_t rows) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (const float u : {0.0F, 1.0F}) {
      const glm::vec2 uv(u, 1 - static_cast<float>(row) / static_cast<float>(rows));
      mesh.uv[0].push_back(uv);
      mesh.position.push_back(leaf.at(uv));
    }
    if (row == 0) continue;
    const std::uint32_t a = first + 2 * row - 2;
    for (const std::uint32_t i : {a, a + 1, a + 3, a, a + 3, a + 2}) mesh.index.wide.push_back(i);
  }
}

float uniform(Rng& rng, double low, double high) { return static_cast<float>(rng.uniform(low, high)); }

std::vector<Leaf> random_leaves(std::size_t count) {
  Rng rng(7);
  std::vector<Leaf> leaves;
  for (std::size_t i = 0; i < count; ++i) {
    glm::quat turn(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
    leaves.push_back(
        {glm::vec3(uniform(rng, 0, 4), uniform(rng, 0, 4), uniform(rng, 0, 4)), glm::normalize(turn), 0.8F});
  }
  return leaves;
}

/// A model of one node whose levels are these meshes.
Model model_of(std::vector<Mesh> levels) {
  Model model;
  Node node;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    model.meshes.push_back({});
    model.meshes.back().primitives.push_back({std::move(levels[i]), -1, {}});
    if (i == 0) {
      node.mesh = 0;
    } else {
      node.lods.push_back(static_cast<int>(i));
    }
  }
  model.nodes.push_back(node);
  return model;
}

const Mesh& mesh_of(const Model& model, std::size_t level) { return model.meshes[level].primitives[0].mesh; }

class NextPositions : public testing::Test {
 protected:
  Job job = Job(1, Job::Options{});
};

TEST_F(NextPositions, MovesALeafToTheSameTextureCoordinatesAndShrinksALeafThatGoes) {
  const std::vector<Leaf> leaves = random_leaves(200);
  Mesh fine = empty_mesh(job), coarse = empty_mesh(job);
  for (const Leaf& leaf : leaves) add(fine, leaf, 2);
  for (std::size_t i = 0; i < leaves.size(); i += 2) add(coarse, {leaves[i].stalk, leaves[i].turn, 1.1F}, 1);
  std::vector<Mesh> levels;
  levels.push_back(std::move(fine));
  levels.push_back(std::move(coarse));
  Model model = model_of(std::move(levels));
  add_next_positions(model, job);

  const Mesh& mesh = mesh_of(model, 0);
  ASSERT_EQ(mesh.next_position.size(), mesh.position.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const glm::vec3& first = mesh.next_position[6 * i];
    for (std::size_t v = 6 * i; v < 6 * i + 6; ++v) {
      const Leaf larger{leaves[i].stalk, leaves[i].turn, 1.1F};
      const glm::vec3 wanted = i % 2 == 0 ? larger.at(mesh.uv[0][v]) : first;
      EXPECT_LT(glm::distance(mesh.next_position[v], wanted), 1e-5F) << "leaf " << i;
    }
    if (i % 2 == 1) {
      EXPECT_LT(glm::distance(first, leaves[i].stalk), 0.41F) << "half of the width";
    }
  }
}

TEST_F(NextPositions, KeepsTheFrontOfALeafApartFromItsBack) {
  Mesh fine = empty_mesh(job), coarse = empty_mesh(job);
  for (const Leaf& leaf : random_leaves(40)) {
    for (Mesh* mesh : {&fine, &coarse}) {
      const std::size_t corner = mesh->index.wide.size();
      add(*mesh, leaf, 1);
      add(*mesh, {leaf.stalk - leaf.turn * glm::vec3(0, 0, 0.003F), leaf.turn, leaf.size}, 1);
      for (std::size_t i = corner + 6; i < corner + 12; i += 3)
        std::swap(mesh->index.wide[i + 1], mesh->index.wide[i + 2]);
    }
  }
  std::vector<Mesh> levels;
  levels.push_back(std::move(fine));
  levels.push_back(std::move(coarse));
  Model model = model_of(std::move(levels));
  add_next_positions(model, job);
  const Mesh& mesh = mesh_of(model, 0);
  for (std::size_t v = 0; v < mesh.position.size(); ++v)
    EXPECT_LT(glm::distance(mesh.next_position[v], mesh.position[v]), 1e-5F);
}

TEST_F(NextPositions, MovesOtherVerticesToTheNearestPointOfTheSurface) {
  Rng rng(3);
  Mesh fine = empty_mesh(job), coarse = empty_mesh(job);
  for (int i = 0; i < 300; ++i) {
    fine.position.push_back(glm::vec3(uniform(rng, 0, 9), uniform(rng, -1, 1), uniform(rng, 0, 9)));
    fine.uv[0].push_back({static_cast<float>(i), 0});
    fine.index.wide.push_back(static_cast<std::uint32_t>(i));
  }
  for (const glm::vec3& corner : {glm::vec3(-1, 0, -1), glm::vec3(-1, 0, 99), glm::vec3(99, 0, -1)}) {
    coarse.position.push_back(corner);
    coarse.uv[0].push_back({corner.x, corner.z});
    coarse.index.wide.push_back(static_cast<std::uint32_t>(coarse.index.wide.size()));
  }
  std::vector<Mesh> levels;
  levels.push_back(std::move(fine));
  levels.push_back(std::move(coarse));
  Model model = model_of(std::move(levels));
  add_next_positions(model, job);
  for (std::size_t v = 0; v < 300; ++v) {
    const glm::vec3 &at = mesh_of(model, 0).position[v], &next = mesh_of(model, 0).next_position[v];
    EXPECT_LT(glm::distance(next, glm::vec3(at.x, 0, at.z)), 1e-5F);
  }
  for (std::size_t v = 0; v < 3; ++v)
    EXPECT_EQ(mesh_of(model, 1).next_position[v], mesh_of(model, 1).position[v]) << "the last level";
}

/// A square of this side in the plane of x and z, in `cells` by `cells` squares without common vertices, whose texture
/// coordinates span the whole. Heights are random up to `rise`.
Mesh fragments(std::uint32_t cells, float side, float rise, const Job& job) {
  Rng rng(5);
  Mesh mesh = empty_mesh(job);
  for (std::uint32_t i = 0; i < cells * cells; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const std::uint32_t corner : {0U, 1U, 2U, 3U}) {
      const glm::vec2 uv =
          glm::vec2(i % cells + corner % 2, i / cells + corner / 2) / static_cast<float>(cells);
      mesh.uv[0].push_back(uv);
      mesh.position.push_back({side * uv.x, uniform(rng, 0, 1) * rise, side * uv.y});
    }
    for (const std::uint32_t k : {0U, 2U, 3U, 0U, 3U, 1U}) mesh.index.wide.push_back(first + k);
  }
  return mesh;
}

TEST_F(NextPositions, MovesTheFragmentsOfAGroundToItsSurface) {
  std::vector<Mesh> levels;
  levels.push_back(fragments(20, 9, 0.5F, job));
  levels.push_back(fragments(6, 9, 1e-6F, job));  // heights differ, so that no two squares have a common edge
  Model model = model_of(std::move(levels));
  add_next_positions(model, job);
  const Mesh& mesh = mesh_of(model, 0);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const glm::vec3& at = mesh.position[v];
    EXPECT_LT(glm::distance(mesh.next_position[v], glm::vec3(at.x, 0, at.z)), 1e-5F);
  }
}

TEST_F(NextPositions, LeavesVerticesBeforeAnImpostorAndModelsOfOneLevelAsTheyAre) {
  std::vector<Mesh> levels;
  for (int i = 0; i < 2; ++i) {
    levels.push_back(empty_mesh(job));
    add(levels.back(), {{0, static_cast<float>(i), 0}}, 1);
  }
  Model model = model_of(std::move(levels));
  model.nodes[0].has_impostor = true;
  add_next_positions(model, job);
  for (std::size_t v = 0; v < 4; ++v)
    EXPECT_EQ(mesh_of(model, 0).next_position[v], mesh_of(model, 0).position[v]);
  EXPECT_TRUE(mesh_of(model, 1).next_position.empty()) << "the impostor";

  std::vector<Mesh> one;
  one.push_back(empty_mesh(job));
  add(one.back(), {}, 1);
  Model single = model_of(std::move(one));
  add_next_positions(single, job);
  EXPECT_TRUE(mesh_of(single, 0).next_position.empty());
}

}  // namespace
}  // namespace seedmesh
