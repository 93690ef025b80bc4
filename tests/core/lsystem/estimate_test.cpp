/// Estimated sizes of tubes that are not welded.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "core/generators/lsystem/lsystem.h"
#include "core/geom/mesh/finish.h"
#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

/// The number of triangles of bark, or of everything.
std::uint64_t triangles_made(const LsystemParams& params, std::uint64_t seed, bool with_organs = false) {
  Job job = job_of(seed);
  Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model) << model.error().issues[0].message;
  if (with_organs) return count(*model).triangles;
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
    const std::uint64_t whole = triangles_made(params, seed, true);
    if (params.surfaces.empty() && estimated != whole) {
      EXPECT_EQ(estimated, triangles_made(params, seed));
    } else if (whole <= 200'000) {
      EXPECT_EQ(estimated, whole);
    }
    ++counted;
  }
  EXPECT_GT(counted, 20U);
}

TEST(Estimate, CountsSystemsWhoseSizeIsRandom) {
  // A tube of six sides has 24 triangles. The seed decides which of both rules is chosen.
  LsystemParams params = grammar_of("A", {"A -> F : 0.5", "A -> F[+(90)F][-(90)F] : 0.5"}, 1);
  params.sides = 6;
  std::set<std::uint64_t> found;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const std::uint64_t estimated = triangles_estimated(params, seed);
    EXPECT_EQ(estimated, triangles_made(params, seed, true));
    found.insert(estimated);
  }
  EXPECT_EQ(found, (std::set<std::uint64_t>{24, 72}));
}

TEST(Estimate, IsLeftOutWhereARandomSystemIsTooLargeToBeMadeFirst) {
  const LsystemParams params = grammar_of("A", {"A -> FAA : 0.5", "A -> AFA : 0.5"}, 17);  // 393,215 modules
  Job job = job_of(1);
  const Result<Appraisal> appraisal = appraise(params, context_of(job));
  ASSERT_TRUE(appraisal);
  EXPECT_FALSE(appraisal->estimate);
  EXPECT_EQ(job.spent(Resource::modules), 0U);
}

}  // namespace
}  // namespace seedmesh::lsystem
