/// Packed ahead or not, a file has the same bytes.
#include "core/gltf/compress/pack.h"

#include <gmock/gmock.h>

#include "core/gltf/compress/quantize.h"
#include "tests/core/gltf/samples.h"
#include "tests/support/narrow.h"

namespace seedmesh {
namespace {

using namespace samples;

/// A rolling sheet of side * side vertices.
Mesh sheet(std::uint32_t side, float step, const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const float height = static_cast<float>(x * 37 % 11 + z * 53 % 13) * 0.01F;
      mesh.position.push_back({static_cast<float>(x) * step, height, static_cast<float>(z) * step});
      mesh.normal.push_back({0, 1, 0});
      mesh.uv[0].push_back(glm::vec2(x, z) / static_cast<float>(side));
      mesh.color.push_back({x % 256, z % 256, 0, 255});
    }
  }
  for (std::uint32_t z = 0; z + 1 < side; ++z) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = z * side + x;
      for (const std::uint32_t corner : {a, a + side, a + side + 1, a, a + side + 1, a + 1})
        mesh.index.wide.push_back(corner);
    }
  }
  narrow(mesh, job);
  mesh.bounds = bounds_of(mesh.position.span());
  return mesh;
}

/// A great sheet with a coarser level, and squares that share views with what it does not fill.
Model landscape(const Job& job) {
  Model model = model_of(sheet(380, 0.5F, job), sheet(95, 2, job), square(job), square(job, 3));
  model.nodes[0].lods = {model.nodes[1].mesh};
  model.nodes[1].mesh = -1;
  return model;
}

Payload compressed(Model model, Container container) {
  Job fresh = job();
  return write(std::move(model), {container, "seedmesh test", {.compressed = true, .lods_inside = true}},
               fresh);
}

std::size_t packed_in(const Model& model) {
  std::size_t packed = 0;
  for (const MeshGroup& group : model.meshes)
    for (const Primitive& each : group.primitives) packed += each.mesh.packed ? 1 : 0;
  return packed;
}

TEST(Pack, LeavesEveryByteOfTheFileAsItWas) {
  for (const Container container : {Container::glb, Container::gltf, Container::zip}) {
    Job fresh = job();
    Model ahead = landscape(fresh);
    gltf::pack(ahead, fresh);
    EXPECT_EQ(packed_in(ahead), 4U);
    EXPECT_EQ(compressed(std::move(ahead), container).text(), compressed(landscape(fresh), container).text());
  }
}

TEST(Pack, KeepsTheSummaryOfTheMeshAndNoneOfItsArrays) {
  Job fresh = job();
  Model model = landscape(fresh);
  const ModelCounts before = count(model);
  const Box box = bounds_of(model);
  const std::uint64_t used = fresh.budget()->used();
  gltf::pack(model, fresh);
  const ModelCounts after = count(model);
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(after.vertices, before.vertices);
  EXPECT_EQ(after.bytes, before.bytes);
  EXPECT_EQ(bounds_of(model).min, box.min);
  EXPECT_EQ(bounds_of(model).max, box.max);
  EXPECT_LT(fresh.budget()->used(), used / 2);
}

TEST(Pack, LeavesMeshesWhoseTexturesAreStillToCome) {
  Job fresh = job();
  Model model = landscape(fresh);
  model.materials.push_back(paint("bark"));
  model.materials.back().recipe.kind = "oak_bark";
  model.meshes[2].primitives[0].material = static_cast<int>(model.materials.size()) - 1;
  gltf::pack(model, fresh);
  EXPECT_EQ(packed_in(model), 3U);
  EXPECT_FALSE(model.meshes[2].primitives[0].mesh.packed);
}

TEST(Pack, KeepsTheGridsOfTheModel) {
  Job fresh = job();
  Model model = landscape(fresh);
  const std::vector<gltf::Grid> before = gltf::grids_of(model);
  gltf::pack(model, fresh);
  const std::vector<gltf::Grid> after = gltf::grids_of(model);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].origin, before[i].origin);
    EXPECT_EQ(after[i].step, before[i].step);
  }
}

}  // namespace
}  // namespace seedmesh
