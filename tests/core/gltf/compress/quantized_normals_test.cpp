/// Faces as small as the steps of a grid keep normals that look their way.
#include "core/gltf/compress/quantized_normals.h"
#include "core/gltf/compress/vertex_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/job.h"
#include "core/base/rng.h"
#include "core/gltf/compress/quantize.h"

namespace seedmesh::gltf {
namespace {

/// A large triangle, and one of about a grid's step with normals that hardly look its way.
Model two_faces(const Job& job, std::uint64_t seed) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  Rng rng(seed);
  const auto any = [&] {
    glm::vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<float>(rng.uniform(-1, 1));
    return v;
  };
  const float step = 2.0F / 65'536;
  for (const glm::vec3& at : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
    mesh.position.push_back(at);
  for (int i = 0; i < 3; ++i) mesh.position.push_back(glm::vec3(0.3F) + step * any());
  const glm::vec3 face = glm::cross(mesh.position[4] - mesh.position[3], mesh.position[5] - mesh.position[3]);
  glm::vec3 aside = 4.0F * any() * std::sqrt(glm::dot(face, face));
  if (glm::dot(aside + face, face) < 0) aside = -aside;
  const glm::vec3 normal = (aside + face) / std::sqrt(glm::dot(aside + face, aside + face));
  for (std::uint32_t i = 0; i < 6; ++i) {
    mesh.normal.push_back(i < 3 ? glm::vec3(0, 0, 1) : normal);
    mesh.index.wide.push_back(i);
  }
  Model model;
  Node node;
  node.mesh = 0;
  model.nodes.push_back(std::move(node));
  model.meshes.push_back({"faces", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  return model;
}

/// Corners of the quantized part that look inward, by its own positions and normals.
struct Outcome {
  std::size_t inward_before = 0, inward = 0;
  bool is_repaired = false;  ///< a normal has changed
};

Outcome after_quantizing(std::uint64_t seed) {
  Job job(1, Job::Options{});
  Model model = two_faces(job, seed);
  const OctahedralNormal given = octahedral(glm::dvec3(model.meshes[0].primitives[0].mesh.normal[3]));
  Outcome result;
  const std::vector<Grid> grids = apply_grids(model);
  Columns columns = take_columns(model);
  result.inward_before = inward_corners(columns.meshes[0][0], job).size();
  quantize(columns, grids, job);
  const Part& part = columns.meshes[0][0];
  for (std::size_t t = 0; t + 2 < part.index->count; t += 3) {
    glm::dvec3 at[3], normal[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = load<std::uint16_t>(part.index->slice, t + k);
      at[k] = glm::dvec3(load<glm::u16vec4>(part.columns[0].slice, corner));
      const auto packed = load<OctahedralNormal>(part.columns[1].slice, corner);
      if (t == 3) result.is_repaired = result.is_repaired || packed != given;
      normal[k] = {packed[0] / 511.0, packed[1] / 511.0, 0};
      normal[k].z = 1 - std::abs(normal[k].x) - std::abs(normal[k].y);
      if (normal[k].z < 0) {
        const double fold = -normal[k].z;
        normal[k].x += normal[k].x >= 0 ? -fold : fold;
        normal[k].y += normal[k].y >= 0 ? -fold : fold;
      }
    }
    const glm::dvec3 face = glm::cross(at[1] - at[0], at[2] - at[0]);
    for (const glm::dvec3& each : normal) result.inward += glm::dot(face, each) < 0 ? 1 : 0;
  }
  return result;
}

TEST(QuantizedNormals, TurnsNormalsThatTheGridHasTurnedAway) {
  std::size_t repaired = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Outcome outcome = after_quantizing(seed);
    ASSERT_EQ(outcome.inward_before, 0U);
    EXPECT_EQ(outcome.inward, 0U) << seed;
    repaired += outcome.is_repaired ? 1 : 0;
  }
  EXPECT_GT(repaired, 0U);
}

}  // namespace
}  // namespace seedmesh::gltf
