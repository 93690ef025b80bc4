/// Bark with grown joints.
#include "core/generators/lsystem/welded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include "core/geom/mesh/finish.h"
#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::lsystem {
namespace {

LsystemParams fork_of_three() {
  LsystemParams params = grammar_of(
      "A(0.3)", {"A(w) -> !(w)F(1.5)[&(30)A(w*0.7)]/(120)[&(30)A(w*0.7)]/(120)[&(30)A(w*0.7)]"}, 4);
  params.weld = true;
  return params;
}

Model made(const LsystemParams& params, Job& job, const Demand& demand = {}) {
  Result<Model> model = generate(params, context_of(job, demand));
  EXPECT_TRUE(model) << model.error().issues[0].message;
  finish(*model, job);
  return std::move(*model);
}

Model made(const LsystemParams& params, const Demand& demand = {}) {
  Job job = job_of(1);
  return made(params, job, demand);
}

/// Returns the meshes of the bark at a level.
std::vector<const Mesh*> bark_of(const Model& model, std::size_t level = 0) {
  std::vector<const Mesh*> meshes;
  for (const Node& node : model.nodes) {
    if (node.name != "bark") continue;
    const int mesh = level == 0 ? node.mesh : node.lods.at(level - 1);
    for (const Primitive& each : model.meshes[static_cast<std::size_t>(mesh)].primitives)
      meshes.push_back(&each.mesh);
  }
  return meshes;
}

std::uint64_t triangles_of(const std::vector<const Mesh*>& meshes) {
  std::uint64_t triangles = 0;
  for (const Mesh* mesh : meshes) triangles += mesh->elements();
  return triangles;
}

void expect_closed(const std::vector<const Mesh*>& meshes) {
  for (const Mesh* mesh : meshes) EXPECT_TRUE(faults(*mesh).empty()) << faults(*mesh)[0];
  const MeshMeasures all = measure(meshes);
  EXPECT_EQ(all.open_edges + all.over_used_edges + all.inconsistent_edges, 0U);
}

/// Returns the number of connected components of a surface after welding vertices by position.
std::size_t pieces_of(const std::vector<const Mesh*>& meshes) {
  std::map<std::tuple<float, float, float>, std::size_t> points;
  std::vector<std::size_t> stands_for;
  const auto find = [&](std::size_t i) {
    while (stands_for[i] != i) i = stands_for[i] = stands_for[stands_for[i]];
    return i;
  };
  for (const Mesh* mesh : meshes) {
    const auto point = [&](std::size_t corner) {
      const glm::vec3 p = mesh->position[mesh->index.at(corner)];
      const auto [place, is_new] = points.try_emplace({p.x, p.y, p.z}, stands_for.size());
      if (is_new) stands_for.push_back(stands_for.size());
      return place->second;
    };
    for (std::size_t i = 0; i + 2 < mesh->index.size(); i += 3) {
      const std::size_t a = point(i), b = point(i + 1), c = point(i + 2);
      stands_for[find(b)] = find(a);
      stands_for[find(c)] = find(a);
    }
  }
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < stands_for.size(); ++i) pieces += stands_for[i] == i ? 1U : 0U;
  return pieces;
}

TEST(Welded, LimbsOfBracketsAreOneSurface) {
  LsystemParams params = fork_of_three();
  const Model welded = made(params);
  expect_closed(bark_of(welded));
  EXPECT_EQ(pieces_of(bark_of(welded)), 1U);
  params.weld = false;
  EXPECT_EQ(pieces_of(bark_of(made(params))), 40U) << "each limb is a tube";
}

TEST(Welded, ColoursContinueBeyondJoints) {
  LsystemParams params = fork_of_three();
  params.productions[0] = "A(w) -> !(w);(1)F(0.7);(2)F(0.8)[&(30);(3)A(w*0.7)]/(120)[&(30)A(w*0.7)]";
  const Model model = made(params);
  EXPECT_EQ(bark_of(model).size(), 2U);
  expect_closed(bark_of(model));
  EXPECT_EQ(pieces_of(bark_of(model)), 1U);
}

TEST(Welded, CoarserLevelsStayClosedAndHaveFewerTriangles) {
  for (const int sides : {3, 5, 8, 20}) {
    LsystemParams params = fork_of_three();
    params.sides = sides;
    const Model model = made(params, {.lods = 4});
    std::uint64_t before = triangles_of(bark_of(model));
    for (std::size_t level = 1; level < 3; ++level) {
      SCOPED_TRACE(std::to_string(sides) + " sides, level " + std::to_string(level));
      expect_closed(bark_of(model, level));
      EXPECT_LT(triangles_of(bark_of(model, level)), before);
      before = triangles_of(bark_of(model, level));
    }
  }
}

TEST(Welded, BarkGrowsByItsBones) {
  const Model model = made(fork_of_three(), {.growth = true});
  ASSERT_EQ(model.animations.size(), 1U);
  for (const Mesh* mesh : bark_of(model)) {
    ASSERT_EQ(mesh->bone.size(), mesh->position.size());
    EXPECT_GT(*std::max_element(mesh->bone.begin(), mesh->bone.end()), 10U);
  }
}

TEST(Welded, ALimbWithAContourStaysAsItIsAndBearsClosedLimbs) {
  LsystemParams params;
  params.axiom = "!(0.5)F[+(50)!(0.1)F]F[-(50)!(0.1)@#(1)FF[+(40)@#(0)!(0.05)F]F]F";
  params.contours = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  params.weld = true;
  const Model model = made(params);
  expect_closed(bark_of(model));
  EXPECT_EQ(pieces_of(bark_of(model)), 3U) << "the trunk with a collar, the limb with the contour, its twig";
}

TEST(Welded, OverlappingClustersStayTubesAndAreReported) {
  LsystemParams params = grammar_of("A", {"A -> F(0.3)+(85)[&(50)A]F(0.3)+(85)A"}, 6);
  params.width = {0.9, 0};
  params.weld = true;
  const Model model = made(params);
  expect_closed(bark_of(model));
}

TEST(Welded, ParametersThatWeldedBarkIgnoresAreReported) {
  LsystemParams params = fork_of_three();
  params.stacks = 3;
  params.adapt = true;
  const auto warnings_of = [&] {
    std::vector<std::string> pointers;
    Job job = job_of(1);
    const Result<Appraisal> appraisal = appraise(params, context_of(job));
    for (const Warning& each : appraisal->warnings) pointers.push_back(each.pointer);
    EXPECT_EQ(made(params).warnings.size(), pointers.size());
    return pointers;
  };
  EXPECT_EQ(warnings_of(), (std::vector<std::string>{"/stacks", "/adapt"}));
  params = fork_of_three();
  params.style = LsystemParams::Style::lines;
  EXPECT_EQ(warnings_of(), std::vector<std::string>{"/weld"});
}

TEST(Welded, TheSameOnOneThreadAndOnMany) {
  LsystemParams params = fork_of_three();
  params.iterations = 6;
  std::vector<Model> models;
  for (const int threads : {1, 8}) {
    Job::Options options;
    options.threads = threads;
    Job job(1, options);
    models.push_back(made(params, job));
  }
  const Mesh &a = *bark_of(models[0])[0], &b = *bark_of(models[1])[0];
  ASSERT_EQ(a.index.size(), b.index.size());
  for (std::size_t i = 0; i < a.index.size(); ++i) ASSERT_EQ(a.index.at(i), b.index.at(i));
  EXPECT_TRUE(std::ranges::equal(a.position, b.position));
}

LsystemParams preset(const std::filesystem::path& path, std::uint64_t& seed) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const Json json = Json::parse(text.str());
  IssueList none;
  seed = json.value("seed", std::uint64_t{0});
  return read_lsystem(json.at("parameters"), "/parameters", none);
}

TEST(Welded, EveryPresetIsClosedAndEstimatedWithinAQuarter) {
  std::size_t estimated = 0;
  const std::filesystem::path presets = std::string(SEEDMESH_SOURCE_DIR) + "/api_schema/presets/lsystem";
  for (const auto& entry : std::filesystem::directory_iterator(presets)) {
    std::uint64_t seed = 0;
    LsystemParams params = preset(entry.path(), seed);
    if (params.style == LsystemParams::Style::lines || params.environment) continue;
    SCOPED_TRACE(entry.path().filename());
    params.weld = true;
    Job job = job_of(seed);
    const Model model = made(params, job);
    expect_closed(bark_of(model));
    Job other = job_of(seed);
    const Result<Appraisal> appraisal = appraise(params, context_of(other));
    ASSERT_TRUE(appraisal);
    // Random systems, and those with organs, are made and counted as a whole.
    if (appraisal->estimate && appraisal->estimate->triangles == count(model).triangles) {
      ++estimated;
      continue;
    }
    const auto triangles = static_cast<double>(triangles_of(bark_of(model)));
    // Curves that overlap themselves are not plants.
    const bool is_curve = entry.path().stem() == "levy_curve" || entry.path().stem() == "penrose_tiling";
    if (!appraisal->estimate || triangles == 0 || is_curve) continue;
    // In narrow forks, limbs of five sides fit less well.
    const double most = params.sides < 6 ? 1.3 : 1.25;
    EXPECT_LT(static_cast<double>(appraisal->estimate->triangles), most * triangles);
    EXPECT_GT(static_cast<double>(appraisal->estimate->triangles), triangles / 1.25);
    ++estimated;
  }
  EXPECT_GT(estimated, 20U);
}

}  // namespace
}  // namespace seedmesh::lsystem
