/// Thin tubes stay surfaces when they are quantized.
#include "core/gltf/compress/merged_points.h"
#include "core/gltf/compress/vertex_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/base/job.h"
#include "core/base/rng.h"
#include "core/gltf/compress/quantize.h"
#include "core/gltf/compress/quantized_normals.h"

namespace seedmesh::gltf {
namespace {

constexpr float step = 2.0F / 65'536;

/// A bent tube about as thin as a step of the grid, with a triangle so large that the grid is that coarse.
void add_thin_tube(Mesh& mesh, std::uint64_t seed) {
  constexpr std::uint32_t sides = 4, rings = 12;
  Rng rng(seed);
  const auto add = [&](const glm::vec3& at) {
    mesh.position.push_back(at);
    mesh.normal.push_back({0, 0, 1});
    return static_cast<std::uint32_t>(mesh.position.size() - 1);
  };
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t i : {a, b, c}) mesh.index.wide.push_back(i);
  };
  face(add({0, 0, 0}), add({1, 0, 0}), add({0, 1, 0}));
  glm::vec3 at(0.3F);
  const std::uint32_t root = add(at - glm::vec3(0, 0, 3 * step));
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const auto radius = static_cast<float>(rng.uniform(0.2, 0.8)) * step;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const float x = i == 0 ? 1.0F : i == 2 ? -1.0F : 0.0F, y = i == 1 ? 1.0F : i == 3 ? -1.0F : 0.0F;
      add(at + radius * glm::vec3(x, y, 0));
    }
    at += step * glm::vec3(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(0.5, 2));
  }
  const std::uint32_t tip = add(at);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides, last = first + (rings - 1) * sides;
    face(root, first + next, first + i);
    face(tip, last + i, last + next);
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t below = first + ring * sides, above = below + sides;
      face(below + i, below + next, above + i);
      face(below + next, above + next, above + i);
    }
  }
}

/// The given number of them, one above the other.
Model thin_tubes(const Job& job, std::uint64_t seed, std::uint64_t count) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (std::uint64_t i = 0; i < count; ++i) add_thin_tube(mesh, seed + i);
  Model model;
  Node node;
  node.mesh = 0;
  model.nodes.push_back(std::move(node));
  model.meshes.push_back({"tube", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  return model;
}

struct Edges {
  std::size_t open = 0, crowded = 0;  ///< of one face, of more than two
};

Edges edges_of(const Part& part) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> faces;
  const auto point = [&](std::size_t i) {
    const auto p = load<glm::u16vec4>(part.columns.front().slice, load<std::uint16_t>(part.index->slice, i));
    return std::uint64_t{p.x} << 32U | std::uint64_t{p.y} << 16U | p.z;
  };
  for (std::size_t i = 0; i < part.index->count; ++i) {
    const std::uint64_t a = point(i), b = point(i % 3 == 2 ? i - 2 : i + 1);
    ++faces[{std::min(a, b), std::max(a, b)}];
  }
  Edges edges;
  for (const auto& [edge, count] : faces) {
    edges.open += count == 1 ? 1U : 0U;
    edges.crowded += count > 2 ? 1U : 0U;
  }
  return edges;
}

TEST(Separate, KeepsThinTubesClosedAndOfTwoFacesAnEdge) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Job job(1, Job::Options{});
    Model model = thin_tubes(job, seed, 1);
    const std::vector<Grid> grids = apply_grids(model);
    ASSERT_EQ(grids.front().step, step);
    Columns columns = take_columns(model);
    quantize(columns, grids, job);
    const Edges edges = edges_of(columns.meshes[0][0]);
    EXPECT_EQ(edges.open, 3U) << "those of the large triangle; seed " << seed;
    EXPECT_EQ(edges.crowded, 0U) << seed;
  }
}

TEST(Separate, KeepsFloatsWhereTheGridIsTooSmall) {
  Job job(1, Job::Options{});
  Model model = thin_tubes(job, 7, 80);
  const Mesh& mesh = model.meshes[0].primitives[0].mesh;
  const std::size_t triangles = mesh.elements();
  std::vector<glm::vec3> before(mesh.position.begin(), mesh.position.end());
  const std::vector<Grid> grids = apply_grids(model);
  Columns columns = take_columns(model);
  quantize(columns, grids, job);
  const Part& part = columns.meshes[0][0];
  const Column& position = part.columns.front();
  ASSERT_EQ(position.component, Component::f32);
  EXPECT_EQ(part.index->count, 3 * triangles) << "none has become flat";
  ASSERT_GE(position.count, before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto at = grids[0].origin + grids[0].step * load<glm::vec3>(position.slice, i);
    EXPECT_LT(glm::distance(at, before[i]), 1e-3F * step);
  }
}

}  // namespace
}  // namespace seedmesh::gltf
