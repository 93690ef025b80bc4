/// The estimate of a scene that `validate` reports, before anything is generated.
#include "core/generators/scene/estimate.h"

#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

std::optional<Estimate> estimated(const Json& json) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(1);
  const Result<Appraisal> appraisal = scene::appraise(own(params), context_of(job));
  EXPECT_TRUE(appraisal);
  return appraisal ? appraisal->estimate : std::nullopt;
}

std::uint64_t triangles_of(const Json& json) {
  const Result<Model> model = scene_of(json);
  EXPECT_TRUE(model);
  return model ? count(*model).triangles : 0;
}

Json field_of(const Json& place) {
  return {{"ground", {{"size", 40}}}, {"layers", {{{"model", cube()}, {"variants", 2}, {"place", place}}}}};
}

TEST(SceneEstimate, IsExactWhereEachPositionIsGiven) {
  const Json place = {
      {"method", "positions"},
      {"positions",
       {{{"at", {0, 0}}},
        {{"at", {4, 2}}},
        {{"at", {8, 2}}, {"model", {{"preset", "menger_sponge"}, {"parameters", {{"iterations", 1}}}}}}}}};
  const std::optional<Estimate> estimate = estimated(field_of(place));
  ASSERT_TRUE(estimate);
  EXPECT_TRUE(estimate->exact);
  EXPECT_EQ(estimate->triangles, triangles_of(field_of(place)));
}

TEST(SceneEstimate, CountsThePositionsThatFitIntoAPattern) {
  for (const Json& place :
       {Json{{"method", "poisson"}, {"distance", 1}}, Json{{"method", "rows"}, {"spacing", {1.5, 2}}},
        Json{{"method", "scatter"}, {"count", 300}},
        Json{{"method", "path"}, {"points", {{-20, 0}, {20, 0}}}, {"distance", 0.5}}}) {
    const std::optional<Estimate> estimate = estimated(field_of(place));
    ASSERT_TRUE(estimate) << place;
    EXPECT_FALSE(estimate->exact);
    const double made = static_cast<double>(triangles_of(field_of(place)));
    EXPECT_NEAR(static_cast<double>(estimate->triangles) / made, 1, 0.15) << place;
  }
}

/// Plants on a terrain, with rules that keep a small part of the positions.
Json on_hills(const Json& place, int seed) {
  return {{"terrain",
           {{"generator", "terrain"},
            {"seed", seed},
            {"parameters",
             {{"algorithm", "fbm"},
              {"resolution", 257},
              {"size", 1000},
              {"amplitude", 250},
              {"water_level", 0}}}}},
          {"layers", {{{"model", cube()}, {"place", place}}}}};
}

TEST(SceneEstimate, SamplesRulesOfSlopeAltitudeAndWater) {
  const Json distance = {{"method", "poisson"}, {"distance", 4}};
  const Json one = {{"method", "positions"}, {"positions", {{{"at", {0, 0}}}}}};
  const auto with = [&](const Json& rules) {
    Json place = distance;
    place.update(rules);
    return place;
  };
  for (const Json& place :
       {with({{"slope", {{"to", 25}}}}), with({{"slope", {{"from", 30}, {"soft", 5}}}}),
        with({{"altitude", {{"from", 20}, {"to", 50}}}}), with({{"above_water", {{"from", 2}, {"to", 20}}}}),
        with({{"noise", {{"wavelength", 60}, {"share", 0.2}}}}),
        with({{"slope", {{"to", 30}}}, {"density", 0.3}}),
        Json{{"method", "path"},
             {"points", {{-480, -400}, {480, 400}}},
             {"distance", 0.5},
             {"slope", {{"to", 40}}}},
        Json{{"method", "scatter"}, {"count", 2000}, {"slope", {{"to", 20}}}}}) {
    for (const int seed : {1, 2, 3}) {
      const std::optional<Estimate> estimate = estimated(on_hills(place, seed));
      const std::optional<Estimate> bare = estimated(on_hills(one, seed));
      ASSERT_TRUE(estimate && bare) << place;
      const double made = static_cast<double>(triangles_of(on_hills(place, seed))) -
                          static_cast<double>(triangles_of(on_hills(one, seed)));
      const double said = static_cast<double>(estimate->triangles) - static_cast<double>(bare->triangles);
      EXPECT_GT(made, 0) << place;
      EXPECT_NEAR(said / made, 1, 0.25) << place << " " << seed;
    }
  }
}

/// A system without an estimate: its word is random, and has more modules than an estimate makes for a count.
Json stochastic() {
  return {{"generator", "lsystem"},
          {"parameters",
           {{"axiom", "A"}, {"productions", {"A -> FAA : 1", "A -> FFAA : 2"}}, {"iterations", 16}}}};
}

TEST(SceneEstimate, IsAbsentWhereNoModelOfALayerHasAnEstimate) {
  Json json = field_of({{"distance", 4}});
  json["layers"][0]["model"] = stochastic();
  EXPECT_FALSE(estimated(json));
}

TEST(SceneEstimate, UsesTheMeanOfALayerForAModelWithoutAnEstimate) {
  const Json positions = {{{"at", {0, 0}}}, {{"at", {4, 2}}}, {{"at", {8, 2}}, {"model", stochastic()}}};
  const std::optional<Estimate> estimate =
      estimated(field_of({{"method", "positions"}, {"positions", positions}}));
  ASSERT_TRUE(estimate);
  EXPECT_FALSE(estimate->exact);
  EXPECT_EQ(estimate->triangles, 2U + 3 * 12);
}

TEST(SceneEstimate, ApproximatesAReducedGround) {
  Json json = field_of({{"distance", 4}});
  json.erase("ground");
  json["terrain"] = {
      {"generator", "terrain"},
      {"parameters", {{"algorithm", "fbm"}, {"resolution", 129}, {"size", 40}, {"mesh", "greedy"}}}};
  const std::optional<Estimate> estimate = estimated(json);
  ASSERT_TRUE(estimate);
  EXPECT_FALSE(estimate->exact);
  EXPECT_GT(estimate->triangles, 2U * 128 * 128 / 8);
}

}  // namespace
}  // namespace seedmesh
