/// What `validate` tells of a scene before anything is made.
#include "core/generators/scene/estimate.h"

#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

std::optional<Estimate> estimated(const Json& json) {
  const Generator::Params params = read_scene_params(json);
  const Job job = job_of(1);
  const Result<Appraisal> appraisal = scene::appraise(own(params), job);
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

TEST(SceneEstimate, IsExactWhereEachPlaceIsGiven) {
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

TEST(SceneEstimate, TakesThePlacesThatAPatternHasRoomFor) {
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

Json stochastic() {
  return {
      {"generator", "lsystem"},
      {"parameters", {{"axiom", "A"}, {"productions", {"A -> FA : 1", "A -> F : 2"}}, {"iterations", 4}}}};
}

TEST(SceneEstimate, IsNothingWhereNoModelOfALayerCanTell) {
  Json json = field_of({{"distance", 4}});
  json["layers"][0]["model"] = stochastic();
  EXPECT_FALSE(estimated(json));
}

TEST(SceneEstimate, TakesTheMeanOfALayerForAModelThatCannotTell) {
  const Json positions = {{{"at", {0, 0}}}, {{"at", {4, 2}}}, {{"at", {8, 2}}, {"model", stochastic()}}};
  const std::optional<Estimate> estimate =
      estimated(field_of({{"method", "positions"}, {"positions", positions}}));
  ASSERT_TRUE(estimate);
  EXPECT_FALSE(estimate->exact);
  EXPECT_EQ(estimate->triangles, 2U + 3 * 12);
}

TEST(SceneEstimate, GuessesAReducedGround) {
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
