/// What is shipped inside, and presets with the overrides of a query.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/pipeline.h"
#include "core/schema/json.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string canonical(const Overrides& overrides, std::string_view name = "koch_island") {
  const auto request = read_preset(name, overrides, Limits{});
  if (request && *request) return (*request)->canonical();
  ADD_FAILURE() << (request ? request->error().issues.front().message : "unknown");
  return "";
}

std::vector<std::string> pointers(const Overrides& overrides) {
  const auto request = read_preset("koch_island", overrides, Limits{});
  std::vector<std::string> all;
  if (request && !*request) {
    for (const Issue& issue : request->error().issues) all.push_back(issue.pointer);
  }
  return all;
}

TEST(Catalog, ListsEveryPresetWithItsText) {
  ASSERT_FALSE(presets().empty());
  std::set<std::string> names;
  for (const PresetInfo& preset : presets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_FALSE(preset.title.empty()) << preset.name;
    EXPECT_FALSE(preset.description.empty()) << preset.name;
    EXPECT_THAT(generator_names(), testing::Contains(preset.generator)) << preset.name;
  }
}

TEST(Catalog, ContainsOnlyValidRequests) {
  for (const PresetInfo& preset : presets()) {
    const Result<Request> request = read_request(*preset_json(preset.name), Limits{});
    ASSERT_TRUE(request) << preset.name << request.error().issues.front().pointer << ": "
                         << request.error().issues.front().message;
    EXPECT_EQ(request->generator(), preset.generator);
  }
}

TEST(Catalog, GivesARequestWithoutTheGallerysWords) {
  const Json request = Json::parse(*preset_json("koch_island"));
  EXPECT_FALSE(request.contains("title"));
  EXPECT_FALSE(request.contains("description"));
  EXPECT_FALSE(request.contains("tags"));
  EXPECT_EQ(preset_json("none"), std::nullopt);
}

TEST(Catalog, HasASchemaForEveryGenerator) {
  for (const std::string_view name : generator_names()) {
    ASSERT_TRUE(schema_json(name)) << name;
    EXPECT_EQ(Json::parse(*schema_json(name)).at("type"), "object");
  }
  EXPECT_THAT(schema_names(), testing::IsSupersetOf({"request", "output", "problem"}));
  EXPECT_EQ(schema_json("common"), std::nullopt);
}

TEST(Catalog, ServesSchemasWithoutReferences) {
  for (const std::string_view name : schema_names())
    EXPECT_THAT(*schema_json(name), testing::Not(HasSubstr("$ref"))) << name;
}

TEST(Catalog, ResolvesEveryReferenceOfTheDescription) {
  const Json document = Json::parse(openapi_json());
  EXPECT_THAT(document.at("openapi").get<std::string>(), testing::StartsWith("3.1"));
  const Json flat = document.flatten();
  int references = 0;
  for (const auto& [pointer, value] : flat.items()) {
    if (!pointer.ends_with("/$ref")) continue;
    ++references;
    const auto target = value.get<std::string>();
    ASSERT_EQ(target.substr(0, 2), "#/") << pointer;
    EXPECT_TRUE(document.contains(Json::json_pointer(target.substr(1)))) << target;
  }
  EXPECT_GT(references, 50);
}

TEST(Overrides, ReachSeedOutputAndParameters) {
  const std::string text =
      canonical({{"seed", "18446744073709551615"}, {"iterations", "2"}, {"output.format", "gltf"}});
  const Json request = Json::parse(text);
  EXPECT_EQ(request["seed"], "18446744073709551615");
  EXPECT_EQ(request["parameters"]["iterations"], 2);
  EXPECT_EQ(request["output"]["format"], "gltf");
  EXPECT_EQ(canonical({}), read_request(*preset_json("koch_island"), Limits{})->canonical());
}

TEST(Overrides, AreReadByTheTypeOfTheirSchema) {
  EXPECT_THAT(canonical({{"ignore", "7"}}), HasSubstr(R"("ignore":"7")"));
  EXPECT_THAT(canonical({{"ignore", "[]"}}), HasSubstr(R"("ignore":"[]")"));
  EXPECT_THAT(canonical({{"angle", "60"}}), HasSubstr(R"("angle":60)"));
  EXPECT_THAT(canonical({{"angle", R"({"yaw":60,"spread":1})"}}),
              HasSubstr(R"("angle":{"spread":1,"yaw":60})"));
  EXPECT_THAT(canonical({{"productions", R"(["F -> F+F"])"}}), HasSubstr(R"("productions":["F -> F+F"])"));
  EXPECT_THAT(canonical({{"constants.r", "2"}}), HasSubstr(R"("constants":{"r":2})"));
  EXPECT_THAT(canonical({{"constants.r", "1+1"}}), HasSubstr(R"("constants":{"r":"1+1"})"));
}

TEST(Overrides, PointAtTheKeyTheyCameBy) {
  EXPECT_THAT(pointers({{"iterations", "many"}}), ElementsAre("/iterations"));
  EXPECT_THAT(pointers({{"seed", "-1"}}), ElementsAre("/seed"));
  EXPECT_THAT(pointers({{"output.format", "obj"}}), ElementsAre("/output.format"));
  EXPECT_THAT(pointers({{"constants.1x", "2"}}), ElementsAre("/constants.1x"));
  EXPECT_THAT(pointers({{"productions", "[\"F F\"]"}}), ElementsAre("/productions"));
  EXPECT_THAT(pointers({{"angle", R"({"yaw":"x"})"}}), ElementsAre("/angle"));
}

TEST(Overrides, SuggestTheSeedBeforeParametersOfASimilarName) {
  const auto oak = read_preset("oak", {{"Seed", "1"}}, Limits{});  // a tree also has the parameter mSeed
  ASSERT_TRUE(oak && !*oak);
  EXPECT_THAT((*oak).error().issues.front().message, HasSubstr("did you mean \"seed\"?"));
}

TEST(Overrides, AreRefusedWhereNothingHasTheirName) {
  EXPECT_THAT(pointers({{"angel", "2"}}), ElementsAre("/angel"));
  EXPECT_THAT(pointers({{"generator", "lsystem"}}), ElementsAre("/generator"));
  EXPECT_THAT(pointers({{"parameters", "{}"}}), ElementsAre("/parameters"));
  EXPECT_THAT(pointers({{"output", "{}"}, {"output.x", "1"}, {"axiom.x", "1"}, {"", "1"}, {"a/b", "1"}}),
              ElementsAre("/output", "/output.x", "/axiom.x", "/", "/a~1b"));
  EXPECT_THAT(pointers({{"seed", "1"}, {"seed", "2"}}), ElementsAre("/seed"));
  EXPECT_THAT(pointers({{"ignore", "\xff"}}), ElementsAre(""));
}

TEST(Overrides, OfTheOutputAreReported) {
  const auto message = [](const char* key) {
    return read_preset("koch_island", {{key, "1"}}, Limits{})->error().issues.front().message;
  };
  EXPECT_EQ(message("output.foo"), "\"output.foo\" is not an option of the output");
  EXPECT_EQ(message("output.lod"),
            "\"output.lod\" is not an option of the output; did you mean \"output.lods\"?");
  EXPECT_THAT(message("lods"), testing::EndsWith("; did you mean \"output.lods\"?"));
  EXPECT_THAT(message("parameters.angle"), testing::EndsWith("; did you mean \"angle\"?"));
  EXPECT_THAT(message("angel"), testing::EndsWith("; did you mean \"angle\"?"));
}

TEST(Overrides, OfAnUnknownPresetAreNotRead) { EXPECT_FALSE(read_preset("none", {}, Limits{}).has_value()); }

}  // namespace
}  // namespace seedmesh
