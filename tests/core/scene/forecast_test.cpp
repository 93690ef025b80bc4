/// Scenes that exceed a limit: when they are refused, and at which pointer.
#include "core/generators/scene/forecast.h"

#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// A stochastic L-system has no estimate.
Json bush(int iterations) {
  return {{"generator", "lsystem"},
          {"parameters",
           {{"axiom", "A"},
            {"productions", {"A -> F[+A][-A] : 3", "A -> F[+A][/A][-A] : 1"}},
            {"iterations", iterations}}}};
}

Json garden(const Json& first, const Json& second, int variants) {
  const Json place = {{"method", "scatter"}, {"count", 400}};
  return {{"layers",
           {{{"name", "first"}, {"model", first}, {"variants", variants}, {"place", place}},
            {{"name", "second"}, {"model", second}, {"variants", variants}, {"place", place}}}}};
}

Job::Options within(std::uint64_t triangles, int threads = 1) {
  Job::Options options;
  options.limits.triangles = triangles;
  options.threads = threads;
  return options;
}

std::uint64_t made(const Json& json) {
  const Generator::Params params = read_scene_params(json);
  Job job(1, Job::Options{});
  EXPECT_TRUE(scene::generate(own(params), context_of(job)));
  return job.spent(Resource::triangles);
}

/// Returns the error of a scene for a limit that it exceeds.
Issue refusal(const Json& json, Job& job) {
  const Generator::Params params = read_scene_params(json);
  try {
    const Result<Model> model = scene::generate(own(params), context_of(job));
    ADD_FAILURE() << "no error was reported";
  } catch (const Stop& stop) {
    return stop.issue();
  }
  return {};
}

TEST(SceneForecast, RefusesByTheEstimatesOfChildrenBeforeAnythingIsMade) {
  const Json sponge = {{"preset", "menger_sponge"}, {"parameters", {{"iterations", 2}}}};
  Job job(1, within(3000));
  const Issue issue = refusal(garden(cube(), sponge, 2), job);
  EXPECT_EQ(issue.pointer, "/layers/1/model");
  EXPECT_THAT(issue.message, HasSubstr("need at least"));
  EXPECT_EQ(job.spent(Resource::triangles), 0U);
}

TEST(SceneForecast, RefusesALayerByTheSizeOfItsFirstModel) {
  const Json json = garden(cube(), bush(7), 32);
  const std::uint64_t whole = made(json);
  for (const int threads : {1, 8}) {
    Job job(1, within(whole / 3, threads));
    const Issue issue = refusal(json, job);
    EXPECT_EQ(issue.pointer, "/layers/1/model");
    EXPECT_THAT(issue.message, HasSubstr("need at least"));
    EXPECT_LT(job.spent(Resource::triangles), whole / 8);
  }
}

TEST(SceneForecast, CountsModulesToo) {
  const Json json = garden(cube(), bush(7), 32);
  const Generator::Params params = read_scene_params(json);
  Job free(1, Job::Options{});
  ASSERT_TRUE(scene::generate(own(params), context_of(free)));
  const std::uint64_t whole = free.spent(Resource::modules);
  Job::Options options;
  options.limits.modules = whole / 3;
  Job job(1, options);
  const Issue issue = refusal(json, job);
  EXPECT_EQ(issue.pointer, "/layers/1/model");
  EXPECT_THAT(issue.message, HasSubstr("modules"));
  EXPECT_LT(job.spent(Resource::modules), whole / 8);
}

TEST(SceneForecast, AcceptsScenesWithinTheLimits) {
  for (const int variants : {1, 3, 8}) {
    const Json json = garden(bush(4), bush(5), variants);
    const Generator::Params params = read_scene_params(json);
    Job job(1, within(made(json)));
    EXPECT_TRUE(scene::generate(own(params), context_of(job))) << variants;
  }
}

TEST(SceneForecast, PointsToTheLayerWhereALimitIsExceeded) {
  const Json json = garden(cube(), bush(6), 2);
  const std::uint64_t whole = made(json);
  for (const int threads : {1, 8}) {
    const Result<Model> model = scene_of(json, 1, within(whole - 1, threads));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, Code::limit);
    EXPECT_EQ(model.error().issues.front().pointer, "/layers/1/model");
  }
}

TEST(SceneForecast, EstimatesManyModelsFromAPartOfThem) {
  const Json json = garden(bush(5), bush(6), 50);
  const std::uint64_t whole = made(json);
  const Generator::Params params = read_scene_params(json);
  for (const int threads : {1, 8}) {
    // more than half: one model of each layer is not enough to decide
    Job job(1, within(whole * 2 / 3, threads));
    const Issue issue = refusal(json, job);
    EXPECT_EQ(issue.pointer, "/layers/1/model");
    EXPECT_THAT(issue.message, HasSubstr("need about"));
    EXPECT_LT(job.spent(Resource::triangles), whole / 2);
  }
  Job enough(1, within(whole));
  EXPECT_TRUE(scene::generate(own(params), context_of(enough)));
}

TEST(SceneForecast, CountsEachCopyThatWillBeMerged) {
  const Json json = garden(cube(), bush(4), 2);
  const Generator::Params params = read_scene_params(json);
  const std::uint64_t once = made(json);
  Job job(1, within(once * 10));
  Demand demand;
  demand.copies = CopyForm::merge;
  EXPECT_THROW(static_cast<void>(scene::generate(own(params), context_of(job, demand))), Stop);
  EXPECT_LT(job.spent(Resource::triangles), once * 2);
}

TEST(SceneForecast, TriesOneModelOfEachLayerWithoutAnEstimate) {
  Json json = garden(cube(), bush(3), 4);
  json["layers"][1]["variants"] = 13;
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(1);
  const scene::VariantTable variant_table = scene::variant_table_of(own(params), job);
  scene::Forecast forecast(own(params), variant_table, context_of(job));
  EXPECT_THAT(forecast.samples(), ElementsAre(4U));
  forecast.set_counts({1, 1, 1, 1, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9}, false);
  EXPECT_THAT(forecast.samples(), ElementsAre(5U));
  forecast.set_counts({1, 1, 1, 1, 0, 1, 0, 0, 9, 9, 9, 9, 9, 0, 0, 0, 0}, false);
  EXPECT_THAT(forecast.samples(), SizeIs(0)) << "a small number is generated at once";
  forecast.set_counts({1, 1, 1, 1, 0, 1, 0, 0, 9, 9, 9, 9, 9, 0, 0, 0, 0}, true);
  EXPECT_THAT(forecast.samples(), ElementsAre(5U));
}

}  // namespace
}  // namespace seedmesh
