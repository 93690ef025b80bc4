#include "core/generators/terrain/decimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/terrain.h"
#include "core/geom/mesh/finish.h"
#include "generated/params/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

Field waves(std::int32_t width, std::int32_t depth) {
  return field_from(width, depth,
                    [](int x, int z) { return 4 * std::sin(x * 0.21) + 3 * std::cos(z * 0.17); });
}

/// Every position of the part is covered once, and no triangle is turned over.
void expect_cover(const Field& field, const Window& part, const Triangulation& mesh) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return grid_point_of(mesh.samples[mesh.index[i + k]], field.width);
    };
    const std::int64_t own = doubled_area(at(0), at(1), at(2));
    ASSERT_GT(own, 0);
    area += own;
  }
  EXPECT_EQ(area, std::int64_t{2} * (part.width - 1) * (part.depth - 1));
}

/// WeldedPoints along the edges that only one triangle has.
std::set<std::pair<int, int>> rim_of(const Field& field, const Triangulation& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.index[i + k], b = mesh.index[i + (k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::set<std::pair<int, int>> positions;
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    if (count > 1) continue;
    for (const std::uint32_t vertex : {edge.first, edge.second}) {
      const GridPoint at = grid_point_of(mesh.samples[vertex], field.width);
      positions.insert({at.x, at.z});
    }
  }
  return positions;
}

TEST(Decimated, CoversAnyPartExactlyOnceWithAnyStep) {
  const Field field = waves(70, 41);
  for (const Window& part : {Window{0, 0, 70, 41}, Window{3, 5, 20, 30}, Window{60, 0, 3, 41},
                             Window{0, 39, 70, 2}, Window{10, 10, 2, 2}, Window{8, 8, 3, 3}}) {
    for (const Border border : {Border::by_error, Border::whole}) {
      for (const std::int32_t step : {2, 4, 8, 16}) {
        Job job = any_job();
        expect_cover(field, part, decimated(field, part, step, border, job));
      }
    }
  }
}

TEST(Decimated, TakesEverySecondSampleOfASideOfAPowerOfTwoAndOne) {
  const Field field = waves(65, 65);
  for (int level = 1; level <= 4; ++level) {
    Job job = any_job();
    const Triangulation mesh = decimated(field, {0, 0, 65, 65}, 1 << level, Border::by_error, job);
    const std::int32_t squares = 64 >> level;
    EXPECT_EQ(mesh.index.size() / 3, static_cast<std::size_t>(2 * squares * squares));
    for (const std::uint32_t sample : mesh.samples) {
      const GridPoint at = grid_point_of(sample, field.width);
      EXPECT_EQ(at.x % (1 << level), 0);
      EXPECT_EQ(at.z % (1 << level), 0);
    }
  }
}

TEST(Decimated, KeepsEverySampleOfAWholeBorderAtEveryStep) {
  const Field field = waves(50, 50);
  const Window part{7, 4, 40, 27};
  std::set<std::pair<int, int>> wanted;
  for (int z = 0; z < 27; ++z) {
    for (int x = 0; x < 40; ++x) {
      if (x == 0 || z == 0 || x == 39 || z == 26) wanted.insert({7 + x, 4 + z});
    }
  }
  for (const std::int32_t step : {2, 4, 8, 16}) {
    Job job = any_job();
    EXPECT_EQ(rim_of(field, decimated(field, part, step, Border::whole, job)), wanted) << step;
  }
}

TerrainParams small(TerrainMesh mesh) {
  TerrainParams params;
  params.iterations = 6;
  params.size = 200;
  params.hurst = 1;
  params.mesh = mesh;
  return params;
}

Model with_levels(const TerrainParams& params, int lods) {
  Job job = any_job();
  Result<Model> model = generate(params, context_of(job, {.lods = lods}));
  EXPECT_TRUE(model);
  if (!model) return {};
  finish(*model, job);
  return std::move(*model);
}

std::vector<std::size_t> triangles_of(const Model& model, const Node& node) {
  std::vector<std::size_t> counts;
  std::vector<int> meshes{node.mesh};
  meshes.insert(meshes.end(), node.lods.begin(), node.lods.end());
  for (const int mesh : meshes)
    counts.push_back(model.meshes[static_cast<std::size_t>(mesh)].primitives[0].mesh.elements());
  return counts;
}

TEST(TerrainLevels, HaveFewerTrianglesEachAndNoDefects) {
  for (const TerrainMesh mesh : {TerrainMesh::grid, TerrainMesh::rtin, TerrainMesh::greedy}) {
    TerrainParams params = small(mesh);
    params.skirt = 5;
    const Model model = with_levels(params, 5);
    EXPECT_THAT(faults(model), IsEmpty());
    const std::vector<std::size_t> counts = triangles_of(model, model.nodes[0]);
    ASSERT_THAT(counts, SizeIs(5)) << text_of(mesh);
    for (std::size_t i = 1; i < counts.size(); ++i) EXPECT_LT(counts[i], counts[i - 1]);
    if (mesh == TerrainMesh::grid) {
      EXPECT_THAT(counts, ::testing::ElementsAre(8192, 2048, 512, 128, 32));
    }
  }
}

TEST(TerrainLevels, DoNotChangeTheFinestLevel) {
  const Model one = with_levels(small(TerrainMesh::greedy), 1),
              three = with_levels(small(TerrainMesh::greedy), 3);
  const Mesh& a = one.meshes[0].primitives[0].mesh;
  const Mesh& b = three.meshes[0].primitives[0].mesh;
  EXPECT_TRUE(std::ranges::equal(a.position, b.position));
  EXPECT_EQ(one.nodes.size(), three.nodes.size());
}

TEST(TerrainLevels, ReportTheErrorOfEachLevel) {
  for (const TerrainMesh mesh : {TerrainMesh::rtin, TerrainMesh::greedy}) {
    TerrainParams params = small(mesh);
    params.max_error = 0.4;
    const Model model = with_levels(params, 4);
    const auto found = std::ranges::find(model.nodes[0].extras, "levels", &Extra::name);
    ASSERT_NE(found, model.nodes[0].extras.end());
    const Json levels = Json::parse(found->json);
    ASSERT_EQ(levels.size(), 3U);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      EXPECT_LE(levels[i]["max_error"].get<double>(), 0.4 * (2 << i));
      EXPECT_EQ(levels[i]["triangles"], triangles_of(model, model.nodes[0])[i + 1]);
    }
  }
}

TEST(TerrainLevels, AreClosedSolidsOnABaseEach) {
  for (const TerrainMesh mesh : {TerrainMesh::grid, TerrainMesh::rtin, TerrainMesh::greedy}) {
    TerrainParams params = small(mesh);
    params.base = 10;
    const Model model = with_levels(params, 4);
    ASSERT_THAT(model.meshes, SizeIs(4));
    for (const MeshGroup& group : model.meshes) {
      std::vector<const Mesh*> parts;
      for (const Primitive& primitive : group.primitives) parts.push_back(&primitive.mesh);
      EXPECT_EQ(measure(parts).open_edges, 0U);
      EXPECT_GT(measure(parts).volume, 0);
    }
  }
}

/// Vertices of a mesh along a line: east of the origin or where `x` lies, by their other coordinate.
std::vector<glm::vec3> along(const Mesh& mesh, float x) {
  std::vector<glm::vec3> line;
  for (const glm::vec3& at : mesh.position) {
    if (at.x == x) line.push_back(at);
  }
  std::sort(line.begin(), line.end(), [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; });
  return line;
}

TEST(TerrainLevels, OfPiecesFitTogetherInAnyCombination) {
  TerrainParams params;
  params.iterations = 9;
  params.skirt = 3;
  const Model model = with_levels(params, 5);
  EXPECT_THAT(faults(model), IsEmpty());
  const Node& west = model.nodes[1];
  const Node& east = model.nodes[2];
  ASSERT_EQ(west.name, "ground_0_0");
  ASSERT_EQ(east.name, "ground_1_0");
  ASSERT_THAT(west.lods, SizeIs(4));
  const auto mesh = [&](int number) -> const Mesh& {
    return model.meshes[static_cast<std::size_t>(number)].primitives[0].mesh;
  };
  const float border = mesh(west.mesh).position[170].x;
  const std::vector<glm::vec3> finest = along(mesh(west.mesh), border);
  ASSERT_THAT(finest, SizeIs(171)) << "512 squares are three pieces of 170 or 171";
  for (const Node* node : {&west, &east}) {
    for (const int lod : node->lods) EXPECT_EQ(along(mesh(lod), border), finest);
  }
}

TEST(TerrainLevels, OfTilesFitTogetherInAnyCombination) {
  for (const TerrainMesh kind : {TerrainMesh::grid, TerrainMesh::rtin, TerrainMesh::greedy}) {
    const auto tile = [&](int x) {
      TerrainParams params = small(kind);
      params.tile.emplace();
      params.tile->x = x;
      return with_levels(params, 4);
    };
    const Model west = tile(0), east = tile(1);
    const auto heights = [](const Model& model, std::size_t level, float x) {
      std::vector<std::pair<float, float>> line;
      for (const glm::vec3& at : along(model.meshes[level].primitives[0].mesh, x))
        line.push_back({at.z, at.y});
      return line;
    };
    const auto wanted = heights(west, 0, 100);
    EXPECT_GT(wanted.size(), 2U);
    for (std::size_t level = 0; level < 4; ++level) {
      EXPECT_EQ(heights(west, level, 100), wanted) << text_of(kind) << level;
      EXPECT_EQ(heights(east, level, -100), wanted) << text_of(kind) << level;
    }
  }
}

TEST(TerrainLevels, OfAPlanetoidAreClosedAndKeepItsHeights) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fbm;
  params.shape = TerrainShape::sphere;
  params.resolution = 33;
  params.water_level = 0;
  const Model model = with_levels(params, 4);
  EXPECT_THAT(faults(model), IsEmpty());
  EXPECT_THAT(triangles_of(model, model.nodes[0]), ::testing::ElementsAre(12288, 3072, 768, 192));
  EXPECT_THAT(model.nodes[1].lods, SizeIs(3));
  const Mesh& finest = model.meshes[0].primitives[0].mesh;
  for (const int lod : model.nodes[0].lods) {
    const Mesh& coarse = model.meshes[static_cast<std::size_t>(lod)].primitives[0].mesh;
    EXPECT_EQ(measure({&coarse}).open_edges, 0U);
    for (const glm::vec3& at : coarse.position)
      ASSERT_NE(std::ranges::find(finest.position, at), finest.position.end());
  }
}

TEST(TerrainLevels, OfADisplacedModelAreSubdividedLess) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fbm;
  params.resolution = 33;
  params.size = 1;
  params.amplitude = 0.05;
  params.onto.emplace();
  params.onto->model.generator = "fractal";
  params.onto->model.parameters = R"({"element":"sphere","iterations":0})";
  params.onto->subdivide = 2;
  Job job = any_job();
  const Result<Model> model = generate(params, context_of(job, {.lods = 5}));
  ASSERT_TRUE(model) << model.error().issues.front().message;
  std::size_t shown = 0;
  for (const Node& node : model->nodes) {
    if (node.mesh < 0) continue;
    ++shown;
    const std::vector<std::size_t> counts = triangles_of(*model, node);
    ASSERT_THAT(counts, SizeIs(3));
    EXPECT_EQ(counts[0], 4 * counts[1]);
    EXPECT_EQ(counts[1], 4 * counts[2]);
  }
  EXPECT_EQ(shown, 1U);
}

}  // namespace
}  // namespace seedmesh::terrain
