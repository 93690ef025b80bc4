/// Bodies at one place, in one mesh.
#include <set>

#include "core/generators/scene/model_levels.h"
#include "core/gltf/compress/quantize.h"
#include "core/model/empty_mesh.h"
#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

/// Nine nodes that show one triangle of this size at one place.
Model nine_triangles(float size, const Job& job) {
  Model model;
  Primitive primitive;
  primitive.mesh = empty_mesh(job);
  for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(size, 0, 0), glm::vec3(0, size, 0)}) {
    primitive.mesh.position.push_back(corner);
    primitive.mesh.normal.push_back({0, 0, 1});
  }
  for (const std::uint32_t i : {0U, 1U, 2U}) primitive.mesh.index.wide.push_back(i);
  model.meshes.push_back({"triangle", {}});
  model.meshes[0].primitives.push_back(std::move(primitive));
  for (int i = 0; i < 9; ++i) {
    Node node;
    node.name = "node_" + std::to_string(i);
    node.mesh = 0;
    model.nodes.push_back(node);
  }
  return model;
}

TEST(SeparateBodies, LeavesNoTwoOnOnePointOfTheGridOfQuantizedVertices) {
  for (const float size : {0.7F, 3.0F, 15.9F, 16.1F, 90.0F}) {
    Job job(1, Job::Options{});
    Model model = nine_triangles(size, job);
    scene::separate_bodies(model, scene::Vertices::quantized);
    std::vector<std::vector<Primitive>> levels = scene::extract_levels(model, job);
    ASSERT_EQ(levels.size(), 1U);
    Model merged;
    merged.meshes.push_back({"merged", std::move(levels[0])});
    const gltf::Grid grid = gltf::grids_of(merged)[0];
    std::set<std::array<int, 3>> points;
    for (const Primitive& each : merged.meshes[0].primitives) {
      for (const glm::vec3& p : each.mesh.position) {
        const glm::vec3 at = (p - grid.origin) / grid.step + 0.5F;
        points.insert({static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)});
        EXPECT_LT(glm::length(p), size * 1.001F);
      }
    }
    EXPECT_EQ(points.size(), 27U) << size;
  }
}

}  // namespace
}  // namespace seedmesh
