#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

Json derived_scene(const Json& json, std::uint64_t seed) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(seed);
  const Result<Json> answer = scene::derive(own(params), {job, {}, generators()});
  EXPECT_TRUE(answer);
  return answer ? *answer : Json();
}

const Json garden = Json::parse(R"json({
  "words": true,
  "layers": [
    {"model": {"generator": "lsystem", "parameters": {"axiom": "F", "productions": ["F -> F[+F[-F]][-F]"], "iterations": 2}},
     "variants": 2, "place": {"method": "positions", "positions": [{"at": [0, 0]}, {"at": [9, 0]}, {"at": [0, 9]}, {"at": [9, 9]}]}},
    {"model": {"generator": "fractal"}, "place": {"method": "positions", "positions": [{"at": [5, 5]}]}}
  ]})json");

TEST(SceneWords, AreThoseOfTheLSystemsThatStandInTheScene) {
  const Json answer = derived_scene(garden, 3);
  ASSERT_TRUE(answer.contains("words"));
  std::set<std::string> placed;
  for (const Json& placement : answer["placements"]) {
    const std::string model = placement["model"];
    if (answer["models"][model]["generator"] == "lsystem") placed.insert(model);
  }
  std::set<std::string> listed;
  for (const auto& [model, word] : answer["words"].items()) {
    listed.insert(model);
    // One F becomes 4, 16; each F adds 3 brackets: 3 and 3 + 12. F[+F[-F]][-F] nests 2 deep, and 2 more in its middle.
    EXPECT_EQ(word["branches"], 15);
    EXPECT_EQ(word["depth"], 4);
    EXPECT_EQ(word["truncated"], false);
    const std::string text = word["string"];
    EXPECT_EQ(std::ranges::count(text, 'F'), 16);
    EXPECT_EQ(word["length"], text.size());
    EXPECT_TRUE(text.starts_with("F[+F[-F]][-F][+F[+F[-F]][-F]"));
  }
  EXPECT_EQ(listed, placed);
}

TEST(SceneWords, AreLeftOutWithoutTheRequest) {
  Json plain = garden;
  plain.erase("words");
  EXPECT_FALSE(derived_scene(plain, 3).contains("words"));
}

/// The pointers of warnings about `words`: of a model, of its appraisal, and of derive.
std::vector<std::string> warned_of(const Json& json) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(3);
  std::vector<std::string> out;
  const auto add = [&out](const char* where, const std::string& pointer) {
    if (pointer == "/words") out.emplace_back(where);
  };
  const Result<Model> model = scene::generate(own(params), {job, {}, generators()});
  EXPECT_TRUE(model);
  if (model) {
    for (const Warning& each : model->warnings) add("model", each.pointer);
  }
  const Result<Appraisal> appraisal = scene::appraise(own(params), {job, {}, generators()});
  EXPECT_TRUE(appraisal);
  if (appraisal) {
    for (const Warning& each : appraisal->warnings) add("appraisal", each.pointer);
  }
  const Json answer = derived_scene(json, 3);
  for (const Json& each : answer["warnings"]) add("derive", each["pointer"]);
  return out;
}

TEST(SceneWords, AreReportedWhereAnAnswerHasNone) {
  EXPECT_EQ(warned_of(garden), std::vector<std::string>{"model"});
  Json bare = garden;
  bare["layers"].erase(0);
  EXPECT_EQ(warned_of(bare), (std::vector<std::string>{"model", "appraisal", "derive"}));
  bare.erase("words");
  EXPECT_EQ(warned_of(bare), std::vector<std::string>{});
}

TEST(SceneWords, AreCutAt64KiB) {
  Json large = garden;
  large["layers"][0]["model"]["parameters"]["iterations"] = 8;
  for (const auto& [model, word] : derived_scene(large, 3)["words"].items()) {
    EXPECT_EQ(word["string"].get<std::string>().size(), 65'536U);
    EXPECT_EQ(word["truncated"], true);
    EXPECT_TRUE(word["depth"].is_null());
    EXPECT_EQ(word["branches"], 65'535);  // 4^8 - 1
  }
}

}  // namespace
}  // namespace seedmesh
