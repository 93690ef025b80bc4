/// Estimates of trees compared with their models.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/generators/tree/tree.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {
namespace {

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::uint64_t triangles_of(const Model& model) {
  std::uint64_t triangles = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      triangles += primitive.mesh.elements();
  }
  return triangles;
}

TEST(Estimate, IsWithinAQuarterOfTheModelOfEveryPreset) {
  const std::filesystem::path presets = std::string(SEEDMESH_SOURCE_DIR) + "/api_schema/presets/tree";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(presets)) {
    const Json preset = Json::parse(text_of_file(entry.path()));
    IssueList faults;
    const TreeParams params = read_tree(preset.at("parameters"), "/parameters", faults);
    ASSERT_TRUE(faults.empty()) << entry.path();
    const auto seed = preset.value("seed", std::uint64_t{0});
    Job job(seed, Job::Options{});
    const Result<Appraisal> appraisal = appraise(params, {job});
    ASSERT_TRUE(appraisal) << entry.path();
    ASSERT_TRUE(appraisal->estimate) << entry.path();
    EXPECT_EQ(job.spent(Resource::triangles), 0U);
    const Result<Model> model = generate(params, {job});
    ASSERT_TRUE(model) << entry.path();
    const auto estimated = static_cast<double>(appraisal->estimate->triangles);
    const auto made = static_cast<double>(triangles_of(*model));
    EXPECT_LT(estimated, 1.25 * made) << entry.path();
    EXPECT_GT(estimated, made / 1.25) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 20U);
}

TEST(Estimate, FollowsAgeRangeAndSeason) {
  TreeParams params;
  const auto estimated = [](const TreeParams& given) {
    Job job(1, Job::Options{});
    return appraise(given, {job})->estimate->triangles;
  };
  const std::uint64_t whole = estimated(params);
  params.range = 300;
  EXPECT_LT(estimated(params), whole / 2);
  params.range = 0;
  params.age = 4;
  EXPECT_LT(estimated(params), whole / 2);
  params.age.reset();
  params.season = TreeSeason::winter;
  EXPECT_LT(estimated(params), whole);
}

TEST(Estimate, IsOmittedWhereItWouldTakeLong) {
  TreeParams params;
  params.branches_1 = 400;
  params.branches_2 = 400;
  params.branches_3 = 100;
  params.Levels = 4;
  Job job(1, Job::Options{});
  const Result<Appraisal> appraisal = appraise(params, {job});
  ASSERT_TRUE(appraisal);
  EXPECT_FALSE(appraisal->estimate);
}

TEST(Estimate, RefusesTreesAboveTheLimits) {
  TreeParams params;
  Job::Options options;
  options.limits.triangles = 6'000;
  Job job(1, options);
  EXPECT_THROW((void)appraise(params, {job}), Stop);
}

}  // namespace
}  // namespace seedmesh::tree
