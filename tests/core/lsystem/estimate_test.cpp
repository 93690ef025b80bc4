/// Estimated sizes of tubes that are not welded.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/generators/lsystem/lsystem.h"
#include "core/geom/mesh/finish.h"
#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

std::uint64_t triangles_made(const LsystemParams& params, std::uint64_t seed) {
  Job job = job_of(seed);
  Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model) << model.error().issues[0].message;
  finish(*model, job);
  std::uint64_t triangles = 0;
  for (const Node& node : model->nodes) {
    if (node.name != "bark") continue;
    for (const Primitive& each : model->meshes[static_cast<std::size_t>(node.mesh)].primitives)
      triangles += each.mesh.elements();
  }
  return triangles;
}

std::uint64_t triangles_estimated(const LsystemParams& params, std::uint64_t seed) {
  Job job = job_of(seed);
  const Result<Appraisal> appraisal = appraise(params, context_of(job));
  EXPECT_TRUE(appraisal);
  return appraisal && appraisal->estimate ? appraisal->estimate->triangles : 0;
}

TEST(Estimate, ASegmentThatIsDrawnTwiceCountsOnce) {
  const LsystemParams once = grammar_of("F", {}, 0), there_and_back = grammar_of("F|F", {}, 0);
  const std::uint64_t tube =
      static_cast<std::uint64_t>(once.sides) * 4;  // a wall of two and two ends of one a side
  EXPECT_EQ(triangles_made(once, 1), tube);
  EXPECT_EQ(triangles_estimated(once, 1), tube);
  EXPECT_EQ(triangles_made(there_and_back, 1), tube);
  EXPECT_EQ(triangles_estimated(there_and_back, 1), tube);
}

TEST(Estimate, PresetsOfTubesAreCountedExactly) {
  std::size_t counted = 0;
  const std::filesystem::path presets = std::string(SEEDMESH_SOURCE_DIR) + "/api_schema/presets/lsystem";
  for (const auto& entry : std::filesystem::directory_iterator(presets)) {
    std::ifstream file(entry.path());
    const Json json = Json::parse(file);
    const std::uint64_t seed = json.value("seed", std::uint64_t{0});
    IssueList none;
    LsystemParams params = read_lsystem(json.at("parameters"), "/parameters", none);
    if (params.style == LsystemParams::Style::lines || params.environment) continue;
    SCOPED_TRACE(entry.path().filename());
    params.weld = false;
    const std::uint64_t estimated = triangles_estimated(params, seed);
    if (estimated == 0) continue;  // without an estimate, or without a limb
    EXPECT_EQ(estimated, triangles_made(params, seed));
    ++counted;
  }
  EXPECT_GT(counted, 20U);
}

}  // namespace
}  // namespace seedmesh::lsystem
