#include "core/generators/terrain/refinement.h"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/generators/terrain/build_model.h"
#include "core/generators/terrain/refined_mesh.h"
#include "core/generators/terrain/surface.h"
#include "core/generators/terrain/terrain.h"
#include "core/geom/mesh/finish.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TerrainRefine around(double east, double south, double radius, double step, double relief = 1) {
  TerrainRefine given;
  given.center = {east, south};
  given.radius = radius;
  given.step = step;
  given.relief = relief;
  return given;
}

/// Hills of 33 by 25 samples, 4 m apart.
Field hills() {
  Field field = field_from(33, 25, [](int x, int z) { return 9 * std::sin(x * 0.4) * std::cos(z * 0.3); });
  field.cell = 4;
  return field;
}

struct Made {
  RefinedMesh refined;
  Mesh plain;
};

Made made(const Field& field, const TerrainRefine& given, PaletteName palette = PaletteName::alpine,
          int threads = 1) {
  Job job = any_job(threads);
  const Window all{0, 0, field.width, field.depth};
  const Sites sites(field, all, Rng(3), job);
  const GroundColors colors(palette, range_of(field, job), -1000);
  const Array<glm::u8vec4> bytes = vertex_colors(field, sites, colors, job);
  const RefinedGround ground(refinement_of(given, field.width, field.depth, field.cell), colors, field, all,
                             Rng(3), job);
  return {refined_mesh(field, ground, colors, bytes, job),
          grid_mesh(field, all, bytes, Shading::smooth, job)};
}

/// Twice the area of a triangle seen from above, positive where it faces up.
double doubled_area(const Mesh& mesh, std::size_t i) {
  const glm::dvec3 a = mesh.position[mesh.index.at(i)];
  return glm::cross(glm::dvec3(mesh.position[mesh.index.at(i + 1)]) - a,
                    glm::dvec3(mesh.position[mesh.index.at(i + 2)]) - a)
      .y;
}

/// At the middle, at a corner, and over the border, with one to five halvings.
std::vector<TerrainRefine> several() {
  return {around(3, 5, 11, 0.9), around(-64, -48, 20, 1.5), around(60, 0, 30, 0.5), around(0, 0, 9, 2),
          around(20, -11, 3, 0.13)};
}

TEST(Refinement, LeavesNoCracks) {
  for (const TerrainRefine& given : several()) {
    const Field field = hills();
    const Mesh mesh = std::move(made(field, given).refined.mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.index.at(i + k), mesh.index.at(i + (k + 1) % 3)}];
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      if (edges.contains({edge.second, edge.first})) continue;
      ++open;
      for (const std::uint32_t v : {edge.first, edge.second}) {
        const glm::vec3& p = mesh.position[v];
        EXPECT_TRUE(std::abs(std::abs(p.x) - 64) < 1e-4 || std::abs(std::abs(p.z) - 48) < 1e-4)
            << "an open edge inside at " << p.x << " " << p.z;
      }
    }
    EXPECT_EQ(open, 2 * (32 + 24)) << "the border has the samples of the field alone";
  }
}

TEST(Refinement, CoversTheFieldOnce) {
  for (const TerrainRefine& given : several()) {
    const Mesh mesh = std::move(made(hills(), given).refined.mesh);
    double sum = 0;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      const double area = doubled_area(mesh, i);
      ASSERT_GT(area, 0);
      sum += area / 2;
    }
    EXPECT_NEAR(sum, 128 * 96, 1e-2);
  }
}

/// The longest edge of a square of side s is its diagonal, seen from above.
TEST(Refinement, HasTheStepWithinTheRadius) {
  for (const TerrainRefine& given : several()) {
    const Mesh mesh = std::move(made(hills(), given).refined.mesh);
    const glm::dvec2 center(given.center[0], given.center[1]);
    const auto at = [&](std::size_t i) {
      const glm::vec3& p = mesh.position[mesh.index.at(i)];
      return glm::dvec2(p.x, p.z);
    };
    std::size_t checked = 0;
    for (std::size_t i = 0; i < mesh.index.size(); ++i) {
      const glm::dvec2 a = at(i), b = at(i % 3 == 2 ? i - 2 : i + 1);
      const bool on_border =
          std::max(std::abs(a.x), std::abs(b.x)) > 60 || std::max(std::abs(a.y), std::abs(b.y)) > 44;
      if (on_border || glm::length(a - center) >= given.radius || glm::length(b - center) >= given.radius)
        continue;
      EXPECT_LE(glm::length(a - b), std::sqrt(2.0) * given.step + 1e-4);
      ++checked;
    }
    EXPECT_GT(checked, 100U);
  }
}

TEST(Refinement, CountsItsTrianglesBefore) {
  for (const TerrainRefine& given : several()) {
    const Field field = hills();
    const Refinement refinement = refinement_of(given, field.width, field.depth, field.cell);
    EXPECT_EQ(made(field, given).refined.mesh.elements(),
              2 * 32 * 24 + added_triangles(refinement, 1U << 30U));
  }
}

TEST(Refinement, KeepsTheFieldBeyondItsReachAndAtTheBorder) {
  const Field field = hills();
  for (const TerrainRefine& given : several()) {
    const Refinement refinement = refinement_of(given, field.width, field.depth, field.cell);
    const Made both = made(field, given);
    const Mesh& mesh = both.refined.mesh;
    std::size_t kept = 0, moved = 0;
    for (std::size_t v = 0; v < both.plain.position.size(); ++v) {
      const glm::vec3& p = both.plain.position[v];
      const double distance = glm::length(glm::dvec2(p.x - given.center[0], p.z - given.center[1]));
      const bool on_border = v % 33 == 0 || v % 33 == 32 || v / 33 == 0 || v / 33 == 24;
      if (distance < refinement.reach() && !on_border) {
        moved += mesh.position[v] == p ? 0 : 1;
        continue;
      }
      ++kept;
      EXPECT_EQ(mesh.position[v], p);
      EXPECT_EQ(mesh.color[v], both.plain.color[v]);
      if (distance > refinement.reach() + 3 * field.cell || on_border) {
        EXPECT_NEAR(glm::distance(mesh.normal[v], both.plain.normal[v]), 0, 1e-5);
      }
    }
    EXPECT_GT(kept, 100U);
    EXPECT_GT(moved, 4U);
  }
}

/// The spline of the filter `resample`, at the same positions.
TEST(Refinement, IsASplineWithoutRelief) {
  const Field field = hills();
  const Mesh mesh = std::move(made(field, around(0, 0, 15, 1, 0)).refined.mesh);
  const Field finer = resampled(field, 32 * 4 + 1, any_job());
  const std::size_t samples = 33 * 25;
  std::size_t compared = 0;
  for (std::size_t v = samples; v < mesh.position.size(); ++v) {
    const glm::vec3& p = mesh.position[v];
    const auto x = static_cast<int>(std::lround(p.x + 64)), z = static_cast<int>(std::lround(p.z + 48));
    EXPECT_NEAR(p.y, finer.at(x, z), 2e-5);
    ++compared;
  }
  EXPECT_GT(compared, 500U);
}

/// The standard deviation of the heights within 20 m of the middle from a plane of a slope.
double roughness(PaletteName palette, double slope, double height) {
  Field field = field_from(33, 33, [&](int x, int) { return height + slope * 4 * (x - 16); });
  field.cell = 4;
  // Two samples give the range of heights, on which grounds depend.
  field.at(0, 0) = -1000;
  field.at(32, 32) = 1000;
  const Mesh mesh = std::move(made(field, around(0, 0, 20, 0.5), palette).refined.mesh);
  double sum = 0, squares = 0, count = 0;
  for (const glm::vec3& p : mesh.position) {
    if (std::hypot(p.x, p.z) > 20) continue;
    const double off = static_cast<double>(p.y) - (height + slope * static_cast<double>(p.x));
    sum += off;
    squares += off * off;
    ++count;
  }
  return std::sqrt(squares / count - sum * sum / (count * count));
}

TEST(Refinement, HasRougherRockThanGrassAndRougherGrassThanSnow) {
  const double rock = roughness(PaletteName::alpine, 1.4, 0),
               grass = roughness(PaletteName::alpine, 0.05, -300),
               snow = roughness(PaletteName::arctic, 0.05, 0);
  EXPECT_GT(rock, 1.5 * grass);
  EXPECT_GT(grass, 1.3 * snow);
  EXPECT_GT(snow, 0.02);
  EXPECT_LT(rock, 2);
}

TerrainParams refined_hills() {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  params.refine = around(10, -5, 12, 0.5);
  return params;
}

Model model_of(const TerrainParams& params, int threads = 1, int lods = 1, int textures = 0) {
  Job job = any_job(threads);
  Demand demand;
  demand.lods = lods;
  demand.textures = textures;
  Result<Model> model = generate(params, {job, demand, {}});
  EXPECT_TRUE(model) << (model ? "" : model.error().issues.front().message);
  if (!model) return {};
  finish(*model, job);
  return std::move(*model);
}

TEST(Refinement, IsSound) {
  for (const bool detail : {false, true}) {
    TerrainParams params = refined_hills();
    params.detail = detail;
    params.skirt = 3;
    params.water_level = 0.001;
    Model model = model_of(params, 1, 1, 64);
    EXPECT_THAT(faults(model), IsEmpty());
    params.skirt = 0;
    params.base = 4;
    model = model_of(params, 1, 1, 64);
    EXPECT_THAT(faults(model), IsEmpty());
  }
}

TEST(Refinement, IsTheSameWithAnyNumberOfThreads) {
  TerrainParams params = refined_hills();
  params.detail = true;
  const Model one = model_of(params, 1, 1, 64), eight = model_of(params, 8, 1, 64);
  ASSERT_EQ(one.meshes[0].primitives.size(), eight.meshes[0].primitives.size());
  for (std::size_t i = 0; i < one.meshes[0].primitives.size(); ++i) {
    const Mesh& a = one.meshes[0].primitives[i].mesh;
    const Mesh& b = eight.meshes[0].primitives[i].mesh;
    EXPECT_TRUE(std::ranges::equal(a.position, b.position));
    EXPECT_TRUE(std::ranges::equal(a.normal, b.normal));
    EXPECT_TRUE(std::ranges::equal(a.color, b.color));
    EXPECT_TRUE(std::ranges::equal(a.uv[1], b.uv[1]));
  }
}

TEST(Refinement, IsEstimatedExactly) {
  TerrainParams params = refined_hills();
  params.skirt = 1;
  Job job = any_job();
  const Result<Appraisal> appraisal = appraise(params, context_of(job));
  ASSERT_TRUE(appraisal && appraisal->estimate);
  EXPECT_TRUE(appraisal->estimate->exact);
  EXPECT_EQ(appraisal->estimate->triangles, count(model_of(params)).triangles);
}

TEST(Refinement, BelongsToTheFinestLevelAlone) {
  TerrainParams params = refined_hills();
  const Model with = model_of(params, 1, 3);
  params.refine.reset();
  const Model without = model_of(params, 1, 3);
  ASSERT_EQ(with.nodes[0].lods.size(), 2U);
  EXPECT_GT(with.meshes[0].primitives[0].mesh.elements(), without.meshes[0].primitives[0].mesh.elements());
  for (std::size_t k = 0; k < 2; ++k) {
    const auto mesh = [&](const Model& model) -> const Mesh& {
      return model.meshes[static_cast<std::size_t>(model.nodes[0].lods[k])].primitives[0].mesh;
    };
    EXPECT_TRUE(std::ranges::equal(mesh(with).position, mesh(without).position));
  }
}

TEST(Refinement, KeepsTheBordersOfTiles) {
  TerrainParams params = refined_hills();
  params.tile.emplace();
  params.refine = around(48, 0, 25, 0.5);
  const Mesh west = std::move(model_of(params).meshes[0].primitives[0].mesh);
  params.refine.reset();
  params.tile->x = 1;
  const Mesh east = std::move(model_of(params).meshes[0].primitives[0].mesh);
  const auto border = [](const Mesh& mesh, float x) {
    std::map<float, std::pair<float, glm::vec3>> heights;
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
      if (mesh.position[v].x == x) heights[mesh.position[v].z] = {mesh.position[v].y, mesh.normal[v]};
    }
    return heights;
  };
  const auto a = border(west, 50), b = border(east, -50);
  ASSERT_EQ(a.size(), 33U);
  ASSERT_EQ(b.size(), 33U);
  for (const auto& [z, of_west] : a) {
    EXPECT_EQ(of_west.first, b.at(z).first);
    EXPECT_NEAR(glm::distance(of_west.second, b.at(z).second), 0, 1e-5);
  }
}

/// The pointers and messages of the errors of generate().
std::string error_of(const TerrainParams& params, Limits limits = {}) {
  Job::Options options;
  options.limits = limits;
  Job job(1, options);
  try {
    const Result<Model> model = generate(params, context_of(job));
    return model ? "" : model.error().issues.front().pointer + " " + model.error().issues.front().message;
  } catch (const Stop& stop) {
    return stop.issue().pointer + " " + stop.issue().message;
  }
}

TEST(Refinement, IsRefusedWhereItDoesNotFit) {
  TerrainParams params = refined_hills();
  params.refine->center = {51, 0};
  EXPECT_THAT(error_of(params), HasSubstr("/refine/center found (51, 0); expected a point within 50 m"));
  params = refined_hills();
  params.refine->step = 3.125;
  EXPECT_THAT(error_of(params),
              HasSubstr("/refine/step found 3.125 m; the squares of the grid have sides of 3.125"));
  params = refined_hills();
  Limits limits;
  limits.triangles = 5000;
  EXPECT_THAT(error_of(params, limits), HasSubstr("/refine/radius needs more than 5000 triangles"));
  params.mesh = TerrainMesh::greedy;
  EXPECT_THAT(error_of(params), HasSubstr("/refine divides the squares of a grid"));
  params = refined_hills();
  params.texture = 64;
  EXPECT_THAT(error_of(params), HasSubstr("/refine divides the squares of a grid"));
  params = small(TerrainAlgorithm::fbm);
  params.shape = TerrainShape::sphere;
  params.refine = around(0, 0, 12, 0.5);
  EXPECT_THAT(error_of(params), HasSubstr("/refine a sphere does not have this parameter"));
  std::vector<std::string> pointers;
  for (const Issue& issue : check_format(refined_hills(), {"png16", "core"}))
    pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, Contains("/refine"));
}

}  // namespace
}  // namespace seedmesh::terrain
