#include "core/geom/mesh/split_inward_corners.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

/// Two triangles of a square that looks up; `low` is the height of the normal at their shared corner 2.
Mesh square(const Job& job, float low) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, 4);
  mesh.normal = Array<glm::vec3>(job, 4);
  mesh.uv[0] = Array<glm::vec2>(job, 4);
  const glm::vec3 corners[] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.position[i] = corners[i];
    mesh.normal[i] = {0, 1, 0};
    mesh.uv[0][i] = {static_cast<float>(i), 0};
  }
  mesh.normal[2] = {0, low, 0};
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(corner);
  return mesh;
}

TEST(SplitInwardCorners, SeparatesVerticesOfCornersThatFaceInward) {
  const Job job(0, Job::Options{});
  Mesh mesh = square(job, -1);
  split_inward_corners(mesh, job);
  ASSERT_EQ(mesh.position.size(), 5U) << "the last corner keeps the vertex, so that none is unused";
  EXPECT_EQ(mesh.normal.size(), 5U);
  EXPECT_EQ(mesh.uv[0].size(), 5U);
  for (const std::size_t corner : {2U, 4U}) {
    const std::uint32_t vertex = mesh.index.wide[corner];
    EXPECT_EQ(mesh.position[vertex], glm::vec3(1, 0, 1));
    EXPECT_EQ(mesh.normal[vertex], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.uv[0][vertex], glm::vec2(2, 0));
  }
}

TEST(SplitInwardCorners, LeavesAllOthers) {
  const Job job(0, Job::Options{});
  Mesh mesh = square(job, 1);
  split_inward_corners(mesh, job);
  EXPECT_EQ(mesh.position.size(), 4U);
}

}  // namespace
}  // namespace seedmesh
