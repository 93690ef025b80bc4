/// Scenes that come to too much: when they are refused, and where that points to.
#include "core/generators/scene/forecast.h"

#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// A stochastic L-system cannot tell what it comes to.
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
  EXPECT_TRUE(scene::generate(own(params), job));
  return job.spent(Resource::triangles);
}

/// What the scene is refused with, for a limit that it passes.
Issue refusal(const Json& json, Job& job) {
  const Generator::Params params = read_scene_params(json);
  try {
    const Result<Model> model = scene::generate(own(params), job);
    ADD_FAILURE() << "it was made";
  } catch (const Stop& stop) {
    return stop.issue();
  }
  return {};
}

TEST(SceneForecast, RefusesWhatChildrenTellBeforeAnythingIsMade) {
  const Json sponge = {{"preset", "menger_sponge"}, {"parameters", {{"iterations", 2}}}};
  Job job(1, within(3000));
  const Issue issue = refusal(garden(cube(), sponge, 2), job);
  EXPECT_EQ(issue.pointer, "/layers/1/model");
  EXPECT_THAT(issue.message, HasSubstr("need at least"));
  EXPECT_EQ(job.spent(Resource::triangles), 0U);
}

TEST(SceneForecast, RefusesAfterOneModelOfALayerWhatManyOfThemComeTo) {
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
  ASSERT_TRUE(scene::generate(own(params), free));
  const std::uint64_t whole = free.spent(Resource::modules);
  Job::Options options;
  options.limits.modules = whole / 3;
  Job job(1, options);
  const Issue issue = refusal(json, job);
  EXPECT_EQ(issue.pointer, "/layers/1/model");
  EXPECT_THAT(issue.message, HasSubstr("modules"));
  EXPECT_LT(job.spent(Resource::modules), whole / 8);
}

TEST(SceneForecast, RefusesNothingThatFits) {
  for (const int variants : {1, 3, 8}) {
    const Json json = garden(bush(4), bush(5), variants);
    const Generator::Params params = read_scene_params(json);
    Job job(1, within(made(json)));
    EXPECT_TRUE(scene::generate(own(params), job)) << variants;
  }
}

TEST(SceneForecast, PointsToTheLayerWhereALimitIsPassedOnTheWay) {
  const Json json = garden(cube(), bush(6), 2);
  const std::uint64_t whole = made(json);
  for (const int threads : {1, 8}) {
    const Result<Model> model = scene_of(json, 1, within(whole - 1, threads));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, Code::limit);
    EXPECT_EQ(model.error().issues.front().pointer, "/layers/1/model");
  }
}

TEST(SceneForecast, SeesFromAPartOfManyModelsWhatTheWholeComesTo) {
  const Json json = garden(bush(5), bush(6), 50);
  const std::uint64_t whole = made(json);
  const Generator::Params params = read_scene_params(json);
  for (const int threads : {1, 8}) {
    Job job(1, within(whole * 2 / 3, threads));  // more than half: one model of each layer does not tell
    const Issue issue = refusal(json, job);
    EXPECT_EQ(issue.pointer, "/layers/1/model");
    EXPECT_THAT(issue.message, HasSubstr("need about"));
    EXPECT_LT(job.spent(Resource::triangles), whole / 2);
  }
  Job enough(1, within(whole));
  EXPECT_TRUE(scene::generate(own(params), enough));
}

TEST(SceneForecast, CountsEachCopyThatWillBeMerged) {
  const Json json = garden(cube(), bush(4), 2);
  const Generator::Params params = read_scene_params(json);
  const std::uint64_t once = made(json);
  Job job(1, within(once * 10));
  Demand demand;
  demand.copies = CopyForm::merge;
  job.set_demand(demand);
  EXPECT_THROW(static_cast<void>(scene::generate(own(params), job)), Stop);
  EXPECT_LT(job.spent(Resource::triangles), once * 2);
}

TEST(SceneForecast, TriesOneModelOfEachLayerThatCannotTell) {
  Json json = garden(cube(), bush(3), 4);
  json["layers"][1]["variants"] = 13;
  const Generator::Params params = read_scene_params(json);
  const Job job = job_of(1);
  const scene::Casting casting = scene::casting_of(own(params), job);
  scene::Forecast forecast(own(params), casting, job);
  EXPECT_THAT(forecast.scouts(), ElementsAre(4U));
  forecast.want({1, 1, 1, 1, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9}, false);
  EXPECT_THAT(forecast.scouts(), ElementsAre(5U));
  forecast.want({1, 1, 1, 1, 0, 1, 0, 0, 9, 9, 9, 9, 9, 0, 0, 0, 0}, false);
  EXPECT_THAT(forecast.scouts(), SizeIs(0)) << "few are made at once";
  forecast.want({1, 1, 1, 1, 0, 1, 0, 0, 9, 9, 9, 9, 9, 0, 0, 0, 0}, true);
  EXPECT_THAT(forecast.scouts(), ElementsAre(5U));
}

}  // namespace
}  // namespace seedmesh
