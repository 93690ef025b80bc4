/// Parameters of a scene that have no effect are reported, and no others.
#include "core/generators/scene/unused.h"

#include "tests/core/scene/support.h"

namespace seedmesh::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The pointers of the warnings of a model.
std::vector<std::string> unused(const Json& json, const Demand& demand = {}) {
  const Generator::Params params = read_scene_params(json);
  std::vector<std::string> pointers;
  for (const Warning& each : unused_settings(own(params), Purpose::model, &demand))
    pointers.push_back(each.pointer);
  return pointers;
}

Json layer(const char* place, const char* more = "{}") {
  Json made = {{"model", {{"generator", "fractal"}}}, {"place", {{"method", "scatter"}, {"count", 3}}}};
  made["place"].update(Json::parse(place));
  made.update(Json::parse(more));
  return made;
}

Json scene_with(std::vector<Json> layers) { return {{"layers", std::move(layers)}}; }

Json on_terrain(Json scene) {
  scene["terrain"] = {{"generator", "terrain"}};
  return scene;
}

TEST(UnusedSettings, OfSlopesAndAltitudesOnLevelGround) {
  const Json scene =
      scene_with({layer(R"({"slope": {"to": 20}, "altitude": {"from": -3}})", R"({"upright": 0.5})")});
  EXPECT_THAT(unused(scene),
              ElementsAre("/layers/0/place/slope", "/layers/0/place/altitude", "/layers/0/upright"));
  EXPECT_THAT(unused(on_terrain(scene)), IsEmpty());
  // No position of level ground has such a slope or height: these limits remove them all.
  EXPECT_THAT(unused(scene_with({layer(R"({"slope": {"from": 5}, "altitude": {"to": -1}})")})), IsEmpty());
}

TEST(UnusedSettings, OfLimitsWithoutEnds) {
  const Json scene = on_terrain(scene_with({layer(R"({"slope": {"soft": 3}, "shade": {"soft": 0.1}})")}));
  EXPECT_THAT(unused(scene), ElementsAre("/layers/0/place/slope", "/layers/0/place/shade"));
}

TEST(UnusedSettings, OfShadeWithoutCrowns) {
  const char* dark = R"({"shade": {"to": 0.5}})";
  const Json with_crown = layer("{}", R"({"crown": 3})");
  EXPECT_THAT(unused(scene_with({layer(dark), with_crown})),
              ElementsAre("/layers/0/place/shade", "/layers/1/crown"));
  EXPECT_THAT(unused(scene_with({with_crown, layer(dark)})), IsEmpty());
  EXPECT_THAT(unused(scene_with({layer(R"({"shade": {"from": 0.5}})")})), IsEmpty()) << "it removes all";
}

TEST(UnusedSettings, OfCompetitionWithoutCrowns) {
  Json scene = scene_with({layer("{}")});
  scene["competition"] = 0.5;
  EXPECT_THAT(unused(scene), ElementsAre("/competition"));
  scene["layers"][0]["crown"] = 2;
  EXPECT_THAT(unused(scene), IsEmpty());
  scene.erase("competition");
  EXPECT_THAT(unused(scene), ElementsAre("/layers/0/crown"));
}

TEST(UnusedSettings, OfTheBeginningOfGrowthWithoutAnimation) {
  Json scene = scene_with({layer("{}", R"({"start": [0, 4]})")});
  scene["layers"][0]["model"] = {{"generator", "tree"}};
  EXPECT_THAT(unused(scene), ElementsAre("/layers/0/start"));
  Demand demand;
  demand.growth = true;
  EXPECT_THAT(unused(scene, demand), IsEmpty());
}

TEST(UnusedSettings, OfTheSideOfAPathInItsMiddle) {
  Json scene = scene_with({layer("{}")});
  scene["layers"][0]["place"] = {
      {"method", "path"}, {"points", {{0, 0}, {9, 0}}}, {"distance", 2}, {"side", "left"}};
  EXPECT_THAT(unused(scene), ElementsAre("/layers/0/place/side"));
  scene["layers"][0]["place"]["offset"] = 1;
  EXPECT_THAT(unused(scene), IsEmpty());
}

TEST(UnusedSettings, OfColoursThatAreNotDrawn) {
  const Json scene = {{"ground", {{"outline", "none"}, {"color", "#ff0000"}}},
                      {"paths", {{{"points", {{0, 0}, {9, 0}}}, {"shown", false}, {"color", "#00ff00"}}}},
                      {"chunks", 4}};
  EXPECT_THAT(unused(scene), ElementsAre("/ground/color", "/paths/0/color", "/chunks"));
}

/// A model, the derivation and the check of a scene have the same warnings.
TEST(UnusedSettings, AreInEveryAnswer) {
  const Json scene = scene_with({layer(R"({"slope": {"to": 20}})")});
  const std::string pointer = "/layers/0/place/slope";
  const Result<Model> model = scene_of(scene);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->warnings.at(0).pointer, pointer);
  EXPECT_EQ(derived_scene(scene)["warnings"].at(0)["pointer"], pointer);
  const Generator::Params params = read_scene_params(scene);
  Job job = job_of(1);
  const Result<Appraisal> appraisal = appraise(own(params), context_of(job));
  ASSERT_TRUE(appraisal);
  EXPECT_EQ(appraisal->warnings.at(0).pointer, pointer);
}

TEST(UnusedSettings, OfFlatRoofsAreErrors) {
  const Json scene = {
      {"buildings",
       {{{"footprint", {{{0, 0}, {8, 0}, {8, 6}, {0, 6}}}}, {"roof", {{"orientation", "across"}}}}}}};
  EXPECT_THAT(scene_errors(scene),
              ElementsAre("/buildings/0/roof/orientation: has no effect on a flat roof"));
}

}  // namespace
}  // namespace seedmesh::scene
