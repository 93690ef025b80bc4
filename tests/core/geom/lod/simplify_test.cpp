#include "core/geom/lod/simplify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geom/lod/thin.h"
#include "core/geom/mesh/finish.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

Mesh empty_mesh(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

/// A torus without a seam.
Mesh torus(const Job& job, std::uint32_t around, std::uint32_t along) {
  Mesh mesh = empty_mesh(job);
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const float a = 6.2831853F * static_cast<float>(i) / static_cast<float>(along);
      const float b = 6.2831853F * static_cast<float>(k) / static_cast<float>(around);
      const glm::vec3 out(std::cos(a), 0, std::sin(a));
      const glm::vec3 n = std::cos(b) * out + glm::vec3(0, std::sin(b), 0);
      mesh.position.push_back(3.0F * out + n);
      mesh.normal.push_back(n / std::sqrt(glm::dot(n, n)));
      mesh.uv[0].push_back({a, b});
    }
  }
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around;
      const std::uint32_t c = (i + 1) % along * around + k, d = (i + 1) % along * around + (k + 1) % around;
      for (const std::uint32_t corner : {a, b, c, b, d, c}) mesh.index.wide.push_back(corner);
    }
  }
  return mesh;
}

/// A flat field of squares with a bump, from `left` to `left` + 1.
Mesh field(const Job& job, std::uint32_t side, float left) {
  Mesh mesh = empty_mesh(job);
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t k = 0; k <= side; ++k) {
      const glm::vec2 p = glm::vec2(k, i) / static_cast<float>(side);
      const float height = 0.1F * std::sin(7 * (p.x + left)) * std::sin(5 * p.y);
      mesh.position.push_back({p.x + left, height, -p.y});
      mesh.normal.push_back({0, 1, 0});
      mesh.uv[0].push_back(p);
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t k = 0; k < side; ++k) {
      const std::uint32_t a = i * (side + 1) + k, b = a + side + 1;
      for (const std::uint32_t corner : {a, a + 1, b, a + 1, b + 1, b}) mesh.index.wide.push_back(corner);
    }
  }
  return mesh;
}

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.materials.resize(1);
  model.meshes.push_back({"mesh", {}});
  for (Mesh& mesh : meshes) model.meshes[0].primitives.push_back({std::move(mesh), 0, {}});
  model.nodes.emplace_back().mesh = 0;
  return model;
}

TEST(Simplify, KeepsAClosedSurfaceClosed) {
  Job job(1, Job::Options{});
  Mesh mesh = torus(job, 24, 60);
  Mesh* const meshes[] = {&mesh};
  const std::uint64_t left = simplify(meshes, 600, {false}, job);
  EXPECT_LE(left, 600U);
  EXPECT_EQ(left, mesh.elements());
  std::vector<Mesh> all;
  all.push_back(std::move(mesh));
  Model model = model_of(std::move(all));
  finish(model, job);
  for (const std::string& fault :
       faults(model)) {  // the order of what is left is no better than that of what was given
    EXPECT_NE(fault.find("cache misses"), std::string::npos) << fault;
  }
}

TEST(Simplify, KeepsVerticesOfTheGivenOnes) {
  Job job(1, Job::Options{});
  Mesh mesh = torus(job, 12, 24);
  const Mesh given = torus(job, 12, 24);
  Mesh* const meshes[] = {&mesh};
  simplify(meshes, 200, {false}, job);
  for (std::size_t v = 0; v < given.position.size(); ++v) EXPECT_EQ(mesh.position[v], given.position[v]);
}

TEST(Simplify, LeavesNoGapBetweenMeshes) {
  Job job(1, Job::Options{});
  Mesh left = field(job, 32, 0), right = field(job, 32, 1);
  Mesh* const meshes[] = {&left, &right};
  EXPECT_LE(simplify(meshes, 500, {false, false}, job), 500U);
  const auto heights_on_the_border = [](const Mesh& mesh) {
    std::vector<std::pair<float, float>> heights;
    for (const std::uint32_t v : mesh.index.wide) {
      if (mesh.position[v].x == 1) heights.emplace_back(mesh.position[v].z, mesh.position[v].y);
    }
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    return heights;
  };
  EXPECT_EQ(heights_on_the_border(left), heights_on_the_border(right));
  EXPECT_GT(heights_on_the_border(left).size(), 2U);
}

TEST(Simplify, KeepsTheOutlineOfASheet) {
  Job job(1, Job::Options{});
  Mesh mesh = field(job, 32, 0);
  for (glm::vec3& p : mesh.position) p.y = 0;
  Mesh* const meshes[] = {&mesh};
  EXPECT_LE(simplify(meshes, 2, {false}, job), 8U);
  glm::dvec3 area(0);
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::dvec3 a(mesh.position[mesh.index.at(i)]);
    area += glm::cross(glm::dvec3(mesh.position[mesh.index.at(i + 1)]) - a,
                       glm::dvec3(mesh.position[mesh.index.at(i + 2)]) - a);
  }
  EXPECT_NEAR(area.y / 2, 1, 1e-6);
}

TEST(Simplify, LeavesFixedMeshesAlone) {
  Job job(1, Job::Options{});
  Mesh mesh = field(job, 8, 0);
  Mesh* const meshes[] = {&mesh};
  EXPECT_EQ(simplify(meshes, 2, {true}, job), 128U);
}

/// Squares that do not touch each other.
Mesh leaves(const Job& job, int count) {
  Mesh mesh = empty_mesh(job);
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
      mesh.position.push_back({corner.x + 3 * static_cast<float>(i), corner.y, 0});
      mesh.normal.push_back({0, 0, 1});
      mesh.uv[0].push_back(corner);
    }
    for (const std::uint32_t c : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(first + c);
  }
  return mesh;
}

TEST(Foliage, IsKnownByItsPieces) {
  const Job job(1, Job::Options{});
  EXPECT_TRUE(is_foliage(leaves(job, 20), job));
  EXPECT_FALSE(is_foliage(leaves(job, 3), job));
  EXPECT_FALSE(is_foliage(torus(job, 12, 24), job));
  EXPECT_FALSE(is_foliage(Mesh{}, job));
}

TEST(Foliage, KeepsItsAreaWithFewerLeaves) {
  const Job job(1, Job::Options{});
  Mesh mesh = leaves(job, 400);
  thin_sheets(mesh, 400, job);
  EXPECT_EQ(mesh.elements(), 400U);
  const std::uint32_t a = mesh.index.at(0), b = mesh.index.at(1);
  EXPECT_NEAR(glm::length(mesh.position[b] - mesh.position[a]), std::sqrt(2.0), 1e-4);
  thin_sheets(mesh, 0, job);
  EXPECT_EQ(mesh.elements(), 2U);  // one leaf stays
}

TEST(Pieces, GoTheSmallestFirst) {
  const Job job(1, Job::Options{});
  Mesh mesh = leaves(job, 20);
  for (std::size_t v = 0; v < 4; ++v) mesh.position[v] *= 10;
  drop_smallest_pieces(mesh, 2, job);
  ASSERT_EQ(mesh.elements(), 2U);
  EXPECT_EQ(mesh.index.at(0), 0U);
}

}  // namespace
}  // namespace seedmesh
