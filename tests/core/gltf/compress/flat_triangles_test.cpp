#include "core/gltf/compress/flat_triangles.h"

#include <gtest/gtest.h>

#include "core/base/job.h"
#include "core/gltf/compress/quantize.h"

namespace seedmesh::gltf {
namespace {

Array<std::uint32_t> array_of(std::initializer_list<std::uint32_t> values, const Job& job) {
  Array<std::uint32_t> array(job);
  for (const std::uint32_t each : values) array.push_back(each);
  return array;
}

std::vector<std::uint32_t> list_of(const Array<std::uint32_t>& array) { return {array.begin(), array.end()}; }

TEST(FlatTriangles, TakesTrianglesThatOccurInBothWindings) {
  Job job(1, Job::Options{});
  Array<std::uint32_t> corners = array_of({0, 1, 2, 4, 5, 6, 1, 0, 2, 2, 1, 3}, job);
  EXPECT_EQ(list_of(taken_pairs(corners, job)), (std::vector<std::uint32_t>{0, 1, 2, 1, 0, 2}));
  EXPECT_EQ(list_of(corners), (std::vector<std::uint32_t>{4, 5, 6, 2, 1, 3}));
  Array<std::uint32_t> repeated = array_of({0, 1, 2, 1, 2, 0}, job);
  EXPECT_TRUE(taken_pairs(repeated, job).empty()) << "twice in one winding";
}

/// Leaves with faces on both sides, and one triangle that has no area on the grid: cleaning must not remove the
/// leaves, which are doubled as well.
TEST(FlatTriangles, KeepsLeavesWithFacesOnBothSides) {
  Job job(1, Job::Options{});
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const glm::vec3& at : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.5F, 0.5F, 1),
                              glm::vec3(0.5F, 0.5F, 1) + glm::vec3(1e-7F, 0, 0),
                              glm::vec3(0.5F, 0.5F, 1) + glm::vec3(0, 1e-7F, 0)}) {
    mesh.position.push_back(at);
    mesh.normal.push_back({0, 0, 1});
  }
  for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 1U, 3U, 4U, 5U}) mesh.index.wide.push_back(corner);
  Model model;
  Node node;
  node.mesh = 0;
  model.nodes.push_back(std::move(node));
  model.meshes.push_back({"leaves", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  const std::vector<Grid> grids = apply_grids(model);
  Columns columns = take_columns(model);
  quantize(columns, grids, job);
  EXPECT_EQ(columns.meshes[0][0].index->count, 6U);
}

}  // namespace
}  // namespace seedmesh::gltf
