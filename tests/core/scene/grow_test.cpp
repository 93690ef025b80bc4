/// Scenes with growing plants.
#include "core/generators/scene/grow.h"

#include <map>
#include <set>

#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Json bed() {
  const Json tree = {{"preset", "proctree_0"}, {"parameters", {{"mLevels", 3}, {"mSegments", 4}}}};
  const Json herb = {
      {"generator", "lsystem"},
      {"parameters", {{"axiom", "A"}, {"productions", {"A -> F[+A][-A]"}}, {"iterations", 4}}}};
  const Json positions = {{"method", "positions"},
                          {"positions", {{{"at", {-4, 0}}}, {{"at", {4, 0}}}, {{"at", {0, 4}}, {"age", 6}}}}};
  return {{"ground", {{"size", 20}}},
          {"layers",
           {{{"name", "tree"}, {"model", tree}, {"variants", 1}, {"place", positions}},
            {{"name", "herb"}, {"model", herb}, {"variants", 2}, {"place", {{"distance", 4}}}},
            {{"name", "stone"}, {"model", cube(0.4)}, {"variants", 1}, {"place", {{"distance", 5}}}}}}};
}

Result<Model> growing(const Json& json, Demand demand = {}) {
  const Generator::Params params = read_scene_params(json);
  Job job(1, Job::Options{});
  demand.growth = true;
  try {
    Result<Model> model = scene::generate(own(params), context_of(job, demand));
    if (model) finish(*model, job);
    return model;
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
}

std::vector<std::string> pointers_of(const Result<Model>& model) {
  std::vector<std::string> all;
  if (model) return all;
  for (const Issue& issue : model.error().issues) all.push_back(issue.pointer);
  return all;
}

TEST(GrowingScene, GivesEveryPlantBonesOfItsOwnAndSharesItsMesh) {
  const Result<Model> model = growing(bed());
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  const Planted made = planted(bed());
  std::set<int> meshes, joints;
  std::size_t plants = 0, bones = 0;
  for (const Node& node : model->nodes) {
    if (node.skin < 0) continue;
    ++plants;
    EXPECT_EQ(node.parent, -1);
    meshes.insert(node.mesh);
    const Skin& skin = model->skins[static_cast<std::size_t>(node.skin)];
    joints.insert(skin.joints.begin(), skin.joints.end());
    bones += skin.joints.size();
  }
  EXPECT_EQ(plants, made.layer(0).size() + made.layer(1).size());
  EXPECT_EQ(meshes.size(), 4U);  // a tree, another of its own age, two herbs
  EXPECT_EQ(joints.size(), bones) << "no bone belongs to two plants";
  ASSERT_EQ(model->animations.size(), 1U);
  EXPECT_EQ(model->animations[0].name, "growth");
}

TEST(GrowingScene, EndsAsTheSceneWithoutGrowth) {
  const Result<Model> model = growing(bed());
  ASSERT_TRUE(model);
  for (const Channel& channel : model->animations.at(0).channels) {
    const std::vector<float>& times = model->animations[0].times.at(static_cast<std::size_t>(channel.times));
    ASSERT_EQ(channel.values.size(), 3 * times.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(channel.values[channel.values.size() - 3 + axis], 1);
  }
  const Result<Model> still = scene_of(bed());
  ASSERT_TRUE(still);
  EXPECT_EQ(count(*model).triangles, count(*still).triangles);
}

TEST(GrowingScene, SharesKeyTimesBetweenThePlantsOfAModel) {
  const Result<Model> model = growing(bed());
  ASSERT_TRUE(model);
  // Each of the four models has at most one list of times for each of its 24 classes of birth.
  EXPECT_LE(model->animations.at(0).times.size(), 4U * 24U);
}

/// Returns start and end of growth of each plant of the layer, by the name of its node.
std::map<std::string, std::pair<float, float>> spans_of(const Model& model, const std::string& layer) {
  std::map<std::string, std::pair<float, float>> spans;
  const Animation& animation = model.animations.at(0);
  for (const Channel& channel : animation.channels) {
    std::size_t node = static_cast<std::size_t>(channel.node);
    while (model.nodes[static_cast<std::size_t>(model.nodes[node].parent)].name != layer) {
      node = static_cast<std::size_t>(model.nodes[node].parent);
      if (model.nodes[node].parent < 0) break;
    }
    if (model.nodes[node].parent < 0) continue;
    const std::vector<float>& times = animation.times.at(static_cast<std::size_t>(channel.times));
    const auto [at, is_new] =
        spans.try_emplace(model.nodes[node].name, std::pair(times.front(), times.back()));
    if (!is_new) {
      at->second.first = std::min(at->second.first, times.front());
      at->second.second = std::max(at->second.second, times.back());
    }
  }
  return spans;
}

TEST(GrowingScene, BeginsEachPlantAtATimeOfItsPosition) {
  Json json = bed();
  const Result<Model> together = growing(json);
  json["layers"][1]["start"] = {1, 5};
  const Result<Model> apart = growing(json);
  ASSERT_TRUE(together && apart);
  const auto before = spans_of(*together, "herb"), after = spans_of(*apart, "herb");
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(before.size(), 4U);
  std::set<float> starts;
  for (const auto& [name, span] : after) {
    ASSERT_TRUE(before.contains(name)) << name;
    EXPECT_GE(span.first, 1);
    EXPECT_LE(span.first, 5);
    EXPECT_FLOAT_EQ(span.second - span.first, before.at(name).second - before.at(name).first);
    starts.insert(span.first);
  }
  EXPECT_GT(starts.size(), 2U);
  EXPECT_EQ(spans_of(*apart, "tree"), spans_of(*together, "tree")) << "other layers are unchanged";
  json["layers"][1]["place"]["slope"] = {{"to", 80}};
  const Result<Model> again = growing(json);
  ASSERT_TRUE(again);
  EXPECT_EQ(spans_of(*again, "herb"), after);
}

TEST(GrowingScene, RefusesAStartOfLayersThatDoNotGrow) {
  Json json = bed();
  json["layers"][1]["start"] = {5, 1};
  json["layers"][2]["start"] = 2;
  EXPECT_THAT(scene_errors(json),
              ElementsAre("/layers/1/start: the first value is above the second; expected [from, to]",
                          "/layers/2/start: fractal does not grow"));
}

TEST(GrowingScene, DoesNotAnimateStones) {
  const Result<Model> model = growing(bed());
  ASSERT_TRUE(model);
  bool found = false;
  for (const Node& node : model->nodes) {
    if (!node.name.starts_with("stone_")) continue;
    found = true;
    EXPECT_EQ(node.skin, -1);
    EXPECT_FALSE(node.instances.transforms.empty());
  }
  EXPECT_TRUE(found);
}

TEST(GrowingScene, GivesManyPlantsFewBonesEach) {
  Json json = bed();
  json["layers"] = Json::array({json["layers"][1]});
  json["layers"][0]["place"] = {{"method", "scatter"}, {"count", 3000}};
  const Result<Model> model = growing(json);
  ASSERT_TRUE(model);
  std::size_t bones = 0;
  for (const Skin& skin : model->skins) bones += skin.joints.size();
  EXPECT_EQ(model->skins.size(), 3000U);
  EXPECT_LE(bones, scene::most_joints);
  json["layers"][0]["place"]["count"] = 12'001;
  EXPECT_THAT(pointers_of(growing(json)), ElementsAre("/output/animation"));
}

TEST(GrowingScene, IsRefusedWithModelsThatCannotGrow) {
  Demand demand;
  demand.copies = CopyForm::gpu;
  EXPECT_THAT(pointers_of(growing(bed(), demand)), ElementsAre("/output/instancing"));
  demand = {};
  demand.lods = 2;
  EXPECT_THAT(pointers_of(growing(bed(), demand)), ElementsAre("/output/lods"));
  Json json = bed();
  json["camera"] = {{"position", {0, 2, 10}}};
  EXPECT_THAT(pointers_of(growing(json)), ElementsAre("/camera"));
  json = bed();
  json["layers"][1]["model"]["parameters"]["style"] = "lines";
  EXPECT_THAT(pointers_of(growing(json)), ElementsAre("/layers/1/model/parameters/style"));
}

TEST(GrowingScene, IsRefusedWhereNothingCanGrow) {
  Json json = bed();
  json["layers"] = Json::array({json["layers"][2]});
  EXPECT_THAT(pointers_of(growing(json)), ElementsAre("/output/animation"));
}

TEST(GrowingScene, ReportsThatNoPlantGrows) {
  Json json = bed();
  json["layers"] = Json::array({json["layers"][1]});
  json["layers"][0]["place"] = {{"method", "scatter"}, {"count", 0}};
  const Result<Model> model = growing(json);
  ASSERT_TRUE(model);
  ASSERT_FALSE(model->warnings.empty());
  EXPECT_EQ(model->warnings.back().pointer, "/output/animation");
}

TEST(Scene, ReportsAnAgeAndASeasonThatNoModelHas) {
  Json json = {{"age", 3}, {"season", "autumn"}, {"layers", Json::array({bed()["layers"][2]})}};
  const Result<Model> stones = scene_of(json);
  ASSERT_TRUE(stones);
  ASSERT_EQ(stones->warnings.size(), 2U);
  EXPECT_EQ(stones->warnings[0].pointer, "/age");
  EXPECT_EQ(stones->warnings[1].pointer, "/season");
  json["layers"] = Json::array({bed()["layers"][0]});
  const Result<Model> trees = scene_of(json);
  ASSERT_TRUE(trees);
  EXPECT_THAT(trees->warnings, IsEmpty());
}

}  // namespace
}  // namespace seedmesh
