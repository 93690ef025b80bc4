#include "core/geom/mesh/box_uv.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

/// Random triangles that share their vertices.
Model tangle(std::uint64_t seed, std::size_t vertices, std::size_t triangles, const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  Rng rng = Rng::of_seed(seed);
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.position.push_back({rng.unit(), rng.unit(), rng.unit()});
    mesh.normal.push_back({0, 1, 0});
    mesh.color.push_back(glm::u8vec4(static_cast<std::uint8_t>(i)));
  }
  for (std::size_t i = 0; i < 3 * triangles; ++i)
    mesh.index.wide.push_back(static_cast<std::uint32_t>(rng.unit() * static_cast<double>(vertices)));
  Model model;
  model.meshes.push_back({"mesh", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  return model;
}

/// The triangles in any order as their corners in `tangle`, which the colours number; the lowest corner is first.
std::multiset<std::array<int, 3>> triangles_of(const Mesh& mesh) {
  std::multiset<std::array<int, 3>> triangles;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    std::array<int, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = mesh.color[mesh.index.at(i + c)].x;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.insert(corners);
  }
  return triangles;
}

double area_of(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

TEST(BoxCoordinates, KeepTrianglesAndCoverAtLeastTheirLargestProjection) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Job job = job_of();
    Model model = tangle(seed, 40, 300, job), before = tangle(seed, 40, 300, job);
    add_box_coordinates(model, job);
    const Mesh &mesh = model.meshes[0].primitives[0].mesh, &old = before.meshes[0].primitives[0].mesh;
    ASSERT_EQ(mesh.uv[0].size(), mesh.position.size());
    ASSERT_EQ(mesh.color.size(), mesh.position.size());
    ASSERT_LE(mesh.position.size(), 6 * old.position.size());
    ASSERT_EQ(triangles_of(mesh), triangles_of(old));
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      std::array<glm::vec3, 3> p;
      std::array<glm::vec2, 3> uv;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.index.at(i + c);
        p[c] = mesh.position[vertex];
        uv[c] = mesh.uv[0][vertex];
        ASSERT_EQ(p[c], old.position[mesh.color[vertex].x]);
      }
      const glm::vec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double largest = 0.5 * std::max({std::abs(across.x), std::abs(across.y), std::abs(across.z)});
      // v grows downwards, so a triangle that is not mirrored has a negative area.
      ASSERT_NEAR(area_of(uv[0], uv[1], uv[2]), -largest, 1e-5);
    }
  }
}

TEST(BoxCoordinates, LeaveMeshesAloneThatHaveSome) {
  Job job = job_of();
  Model model = tangle(1, 10, 10, job);
  Mesh& mesh = model.meshes[0].primitives[0].mesh;
  mesh.uv[0] = Array<glm::vec2>(job, mesh.position.size(), glm::vec2(3));
  add_box_coordinates(model, job);
  EXPECT_EQ(mesh.position.size(), 10U);
  EXPECT_EQ(mesh.uv[0][0], glm::vec2(3));
}

}  // namespace
}  // namespace seedmesh
