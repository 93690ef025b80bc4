/// Every option of the output does what it says, or is refused where it stands.
#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "core/pipeline.h"
#include "core/pipeline/profiles.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::string request_of(const std::string& preset, const std::string& output) {
  return R"({"preset":")" + preset + R"(","output":)" + output + "}";
}

std::vector<std::string> pointers_of(const Error& error) {
  std::vector<std::string> all;
  for (const Issue& issue : error.issues) all.push_back(issue.pointer);
  return all;
}

/// The pointers of the faults of a request, whether they show when it is read or when it is made.
std::vector<std::string> refused(const std::string& preset, const std::string& output) {
  const Result<Request> request = read_request(request_of(preset, output), Limits{});
  if (!request) return pointers_of(request.error());
  const Result<Product> product = produce(*request, {});
  return product ? std::vector<std::string>{} : pointers_of(product.error());
}

struct Made {
  json document;
  Statistics statistics;
};

Made made_of(const std::string& text) {
  const Result<Request> request = read_request(text, Limits{});
  if (!request) {
    ADD_FAILURE() << request.error().issues.front().message;
    return {};
  }
  const Result<Product> product = produce(*request, {});
  if (!product) {
    ADD_FAILURE() << product.error().issues.front().message;
    return {};
  }
  const std::string bytes = product->payload.text();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return {json::parse(bytes.substr(20, size)), product->statistics};
}

Made made(const std::string& preset, const std::string& output) {
  return made_of(request_of(preset, output));
}

std::vector<std::string> required(const json& document) {
  return document.value("extensionsRequired", std::vector<std::string>());
}

TEST(Impostors, AreRefusedWhereNothingCanBeOne) {
  EXPECT_THAT(refused("proctree_0", R"({"impostor":true})"), ElementsAre("/output/impostor"));
  EXPECT_THAT(refused("menger_sponge", R"({"impostor":true,"profile":"web"})"),
              ElementsAre("/output/impostor"));
  EXPECT_THAT(refused("proctree_0", R"({"impostor":true,"profile":"web","textures":"none"})"),
              ElementsAre("/output/impostor"));
  EXPECT_THAT(refused("proctree_0", R"({"impostor":true,"profile":"web","textures":32})"),
              ElementsAre("/output/impostor"));
  EXPECT_THAT(refused("growing_tree", R"({"impostor":true,"profile":"web"})"),
              ElementsAre("/output/impostor"));
}

TEST(Impostors, AreTheCoarsestLevelOfTheWholeTree) {
  const json document =
      made("proctree_0", R"({"impostor":true,"profile":"unity","lods":2,"textures":64})").document;
  const json& nodes = document["nodes"];
  std::size_t with_levels = 0, pictures = 0;
  for (const json& node : nodes) {
    if (!node.contains("extensions") || !node["extensions"].contains("MSFT_lod")) continue;
    ++with_levels;
    const json& levels = node["extensions"]["MSFT_lod"]["ids"];
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(node["extras"]["MSFT_screencoverage"], json::parse("[0.5,0.12,0]"));
    EXPECT_EQ(nodes[levels[0].get<std::size_t>()]["children"].size(), 2U);
    pictures += nodes[levels[1].get<std::size_t>()]["children"].size();
  }
  EXPECT_EQ(with_levels, 1U);  // the root, not bark and leaves each
  EXPECT_EQ(pictures, 1U);
}

/// The bytes of the images of impostors in a grove that is seen from afar.
std::size_t bytes_of_impostors(const std::string& budget) {
  const json document =
      made_of(R"({"generator":"scene","parameters":{"ground":{"size":100},"camera":{"position":[0,2,90]},
    "layers":[{"model":{"preset":"proctree_0","parameters":{"mLevels":3}},"variants":1,
               "place":{"method":"poisson","distance":9}}]},"output":{"textures":128)" +
              budget + "}}")
          .document;
  std::size_t sum = 0;
  for (const json& image : document.at("images")) {
    if (image.at("name").get<std::string>().find("impostor") != std::string::npos)
      sum += document.at("bufferViews")
                 .at(image.at("bufferView").get<std::size_t>())
                 .at("byteLength")
                 .get<std::size_t>();
  }
  return sum;
}

TEST(Impostors, AreDrawnFromTheFinestLevelWhenABudgetRemovesIt) {
  const std::size_t drawn = bytes_of_impostors("");
  EXPECT_GT(drawn, 2000U);
  EXPECT_EQ(bytes_of_impostors(R"(,"max_triangles":4000)"), drawn);
}

TEST(Impostors, AreMadeOfEveryVariant) {
  const json document =
      made("proctree_0", R"({"impostor":true,"profile":"unity","variants":3,"textures":64})").document;
  std::size_t pictures = 0;
  for (const json& material : document["materials"])
    pictures += material["name"].get<std::string>().find("impostor") != std::string::npos ? 1 : 0;
  EXPECT_EQ(pictures, 3U);
}

TEST(Output, RequiresNothingBeyondCoreOfWhoDoesNotReadIt) {
  for (const char* profile : {"core", "unity", "unreal", "godot", "blender"}) {
    const json document = made("hutsko_tree", std::string(R"({"profile":")") + profile + "\"}").document;
    EXPECT_THAT(required(document), IsEmpty()) << profile;
  }
  EXPECT_THAT(required(made("hutsko_tree", R"({"profile":"web"})").document),
              UnorderedElementsAre("KHR_mesh_quantization", "EXT_meshopt_compression"));
}

TEST(Output, RefusesLevelsThatNoFileCanContain) {
  for (const char* profile : {"core", "unreal", "godot", "blender"}) {
    const std::string output = std::string(R"({"lods":3,"profile":")") + profile + "\"";
    EXPECT_THAT(refused("hutsko_tree", output + "}"), ElementsAre("/output/lods")) << profile;
    EXPECT_THAT(refused("hutsko_tree", output + R"(,"format":"zip"})"), IsEmpty()) << profile;
  }
  for (const char* profile : {"web", "unity"}) {
    const json document =
        made("hutsko_tree", std::string(R"({"lods":3,"profile":")") + profile + "\"}").document;
    EXPECT_THAT(document["extensionsUsed"], Contains("MSFT_lod")) << profile;
  }
}

TEST(Output, RefusesLevelsOfWhatCannotBeMadeSimpler) {
  EXPECT_THAT(refused("fern_cloud", R"({"lods":2,"profile":"web"})"), ElementsAre("/output/lods"));
}

/// Triangles of a node and its children.
std::uint64_t triangles_below(const json& document, const json& node) {
  std::uint64_t triangles = 0;
  if (node.contains("mesh")) {
    for (const json& primitive : document["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
      triangles +=
          document["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::uint64_t>() / 3;
    }
  }
  for (const json& child : node.value("children", json::array()))
    triangles += triangles_below(document, document["nodes"][child.get<std::size_t>()]);
  return triangles;
}

/// Triangles of each level of the first node that has some, finest first.
std::vector<std::uint64_t> levels_of(const json& document) {
  std::vector<std::uint64_t> levels;
  const auto add = [&](const json& node) { levels.push_back(triangles_below(document, node)); };
  for (const json& node : document["nodes"]) {
    if (!node.contains("extensions") || !node["extensions"].contains("MSFT_lod")) continue;
    add(node);
    for (const json& id : node["extensions"]["MSFT_lod"]["ids"])
      add(document["nodes"][id.get<std::size_t>()]);
    break;
  }
  return levels;
}

TEST(Output, MakesLevelsOfAModelThatHasNoneOfItsOwn) {
  for (const char* preset : {"mandelbrot", "sponge_of_spheres", "copies_of_a_plant"}) {
    const Made made_of = made(preset, R"({"lods":3,"profile":"unity","textures":"none"})");
    const std::vector<std::uint64_t> levels = levels_of(made_of.document);
    ASSERT_GE(levels.size(), 2U) << preset;
    for (std::size_t i = 1; i < levels.size(); ++i) EXPECT_LE(levels[i] * 10, levels[i - 1] * 9) << preset;
    EXPECT_EQ(made_of.statistics.warnings, levels.size() < 3 ? 1U : 0U) << preset;
    EXPECT_EQ(made_of.statistics.triangles, made(preset, R"({"textures":"none"})").statistics.triangles);
  }
}

TEST(Output, MakesLevelsOfASceneWhoseGroundIsPacked) {
  const Result<Request> request = read_request(
      R"({"generator":"scene","parameters":{"layers":[{"model":{"preset":"sponge_of_spheres"},
          "place":{"method":"scatter","count":3}}]},"output":{"lods":2,"profile":"web"}})",
      Limits{});
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product) << product.error().issues.front().message;
  EXPECT_EQ(product->statistics.warnings, 0U);
}

TEST(Output, WarnsOfFewerLevelsThanRequested) {
  const Made house = made("house", R"({"lods":5,"profile":"unity","textures":"none"})");
  EXPECT_EQ(house.statistics.warnings, 1U);
  EXPECT_THAT(house.document["asset"]["extras"]["warnings"][0]["message"].get<std::string>(),
              HasSubstr("3 levels of detail instead of 5"));
  EXPECT_EQ(made("house", R"({"lods":3,"profile":"unity","textures":"none"})").statistics.warnings, 0U);
}

TEST(Output, ExplainsHowRulesMakeLevels) {
  const auto message = [](const std::string& rules) {
    const std::string body = R"({"generator":"building","parameters":{"rules":")" + rules +
                             R"("},"output":{"lods":2,"profile":"unity"}})";
    const Result<Request> request = read_request(body, Limits{});
    EXPECT_TRUE(request);
    const Result<Product> product = produce(*request, {});
    return product ? "" : product.error().issues.front().message;
  };
  EXPECT_THAT(message("Lot --> extrude(5) Mass."),
              HasSubstr("this model has one and cannot be simplified; rules have their own levels if "
                        "they declare `attr lod = 0`"));
  EXPECT_THAT(message("attr lod = 0\\nLot --> extrude(5) Mass."), HasSubstr("and use it"));
  EXPECT_EQ(message("attr lod = 0\\nLot --> case lod < 1: split(x) { 1: Mass. }* else: extrude(5) Mass."),
            "");
}

TEST(Output, BringsAFinerLevelOfABuildingWithinTheBudget) {
  const auto triangles = [](const char* preset, std::uint64_t most) {
    const std::string budget = most > 0 ? R"(,"max_triangles":)" + std::to_string(most) : "";
    return made(preset, R"({"textures":"none")" + budget + "}").statistics.triangles;
  };
  const std::uint64_t house = triangles("house", 0), temple = triangles("temple", 0);
  EXPECT_LT(triangles("house", house - 1), house);
  EXPECT_GT(triangles("house", house - 1), house * 9 / 10);
  EXPECT_LE(triangles("temple", temple / 2), temple / 2);
  EXPECT_GT(triangles("temple", temple / 2), temple * 4 / 10);
  EXPECT_LT(triangles("temple", temple / 6), temple / 6);  // its own next level
}

TEST(Output, TakesNoWallsOfABuildingForABudget) {
  EXPECT_THAT(refused("cga_house_2006", R"({"max_triangles":3000,"textures":"none"})"),
              ElementsAre("/output/max_triangles"));
  const Made block = made("parisian_block", R"({"max_triangles":20000,"textures":"none"})");
  EXPECT_LE(block.statistics.triangles, 20'000U);
  EXPECT_GT(block.statistics.triangles, 5'000U);
}

TEST(Output, LeavesCollisionShapesOutOfLevels) {
  const json document =
      made("church", R"({"lods":2,"profile":"unity","collision":"plain","textures":"none"})").document;
  std::size_t shapes = 0;
  for (const json& node : document["nodes"]) {
    if (!node.value("name", "").starts_with("collision")) continue;
    ++shapes;
    EXPECT_FALSE(node.contains("extensions") && node["extensions"].contains("MSFT_lod"));
  }
  EXPECT_GT(shapes, 0U);
}

TEST(Output, PutsCopiesOnTheGpuOnlyWhereThatIsRead) {
  for (const char* profile : {"core", "unreal", "godot"}) {
    const std::string output = std::string(R"({"instancing":"gpu","profile":")") + profile + "\"}";
    EXPECT_THAT(refused("copies_of_a_plant", output), ElementsAre("/output/instancing")) << profile;
  }
  for (const char* profile : {"web", "unity", "blender"}) {
    const std::string output = std::string(R"({"instancing":"gpu","profile":")") + profile + "\"}";
    EXPECT_THAT(required(made("copies_of_a_plant", output).document), Contains("EXT_mesh_gpu_instancing"))
        << profile;
  }
}

TEST(Output, ChoosesByItselfHowCopiesAreWritten) {
  const Made core = made("copies_of_a_plant", "{}"), web = made("copies_of_a_plant", R"({"profile":"web"})"),
             merged = made("copies_of_a_plant", R"({"instancing":"merge"})");
  EXPECT_GT(core.document["nodes"].size(), 20U);
  EXPECT_THAT(required(core.document), IsEmpty());
  EXPECT_THAT(required(web.document), Contains("EXT_mesh_gpu_instancing"));
  EXPECT_EQ(merged.document["nodes"].size(), 2U);
  EXPECT_EQ(merged.document["meshes"].size(), 1U);
  EXPECT_EQ(core.statistics.triangles, web.statistics.triangles);
  EXPECT_EQ(core.statistics.triangles, merged.statistics.triangles);
}

TEST(Output, SetsVariantsSideBySide) {
  const Made one = made("leafy_birch", R"({"textures":16})"),
             four = made("leafy_birch", R"({"textures":16,"variants":4})");
  EXPECT_EQ(four.document["materials"].size(), one.document["materials"].size());
  EXPECT_EQ(four.document["images"].size(), one.document["images"].size());
  EXPECT_EQ(four.document["meshes"].size(), 4 * one.document["meshes"].size());
  std::vector<std::uint64_t> seeds;
  for (const json& node : four.document["nodes"]) {
    if (node.contains("extras") && node["extras"].contains("seed")) seeds.push_back(node["extras"]["seed"]);
  }
  const std::uint64_t first = four.document["asset"]["extras"]["seed"];
  EXPECT_THAT(seeds, ElementsAre(first, first + 1, first + 2, first + 3));
}

TEST(Output, RefusesVariantsBeyondTheLastSeed) {
  const Result<Request> request = read_request(
      R"({"preset":"leafy_birch","seed":"18446744073709551615","output":{"variants":2}})", Limits{});
  ASSERT_FALSE(request);
  EXPECT_THAT(pointers_of(request.error()), ElementsAre("/output/variants"));
}

TEST(Output, KeepsABudgetOfTriangles) {
  const std::uint64_t whole = made("growing_tree", R"({"animation":"none"})").statistics.triangles;
  ASSERT_GT(whole, 20'000U);
  for (const int most : {20'000, 9'000, 3'000}) {
    const std::uint64_t drawn =
        made("growing_tree", R"({"animation":"none","max_triangles":)" + std::to_string(most) + "}")
            .statistics.triangles;
    EXPECT_LE(drawn, static_cast<std::uint64_t>(most));
    EXPECT_GT(drawn, static_cast<std::uint64_t>(most / 2));
  }
  EXPECT_EQ(made("growing_tree", R"({"animation":"none","max_triangles":1000000})").statistics.triangles,
            whole);
}

TEST(Output, MakesTheLevelsThatABudgetLeavesNoneOf) {
  const Made coarse =
      made("growing_tree", R"({"animation":"none","lods":4,"profile":"unity","max_triangles":3000})");
  std::vector<std::size_t> drawn(4);
  const json& document = coarse.document;
  const auto triangles_of = [&](const json& node) { return triangles_below(document, node); };
  for (const json& node : document["nodes"]) {
    if (!node.contains("extensions") || !node["extensions"].contains("MSFT_lod")) continue;
    drawn[0] += triangles_of(node);
    const json& levels = node["extensions"]["MSFT_lod"]["ids"];
    ASSERT_EQ(levels.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      drawn[i + 1] += triangles_of(document["nodes"][levels[i].get<std::size_t>()]);
  }
  EXPECT_LE(drawn[0], 3'000U);
  EXPECT_GT(drawn[0], 1'500U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LE(drawn[i], drawn[i - 1] * 3 / 4) << i;
}

TEST(Output, KeepsTheBudgetOfAllVariantsTogether) {
  EXPECT_LE(made("hutsko_tree", R"({"variants":3,"max_triangles":2000})").statistics.triangles, 2'000U);
}

/// Flat ground is simplified without an error, so one point gets more faces than a collapse may have.
TEST(Output, KeepsTheBudgetOfWideFlatGround) {
  const Result<Request> request =
      read_request(R"({"preset":"mandelbrot_satellite","parameters":{"escape":{"span":20}},)"
                   R"("output":{"max_triangles":5000}})",
                   Limits{});
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product);
  EXPECT_LE(product->statistics.triangles, 5'000U);
  EXPECT_GT(product->statistics.triangles, 1'000U);
}

TEST(Output, EstimatesTheBytesOfTerrainsWithTheirTextures) {
  for (const char* preset :
       {"midpoint_hills", "mesas", "dunes", "lava_plain", "boulder", "mossy_rock", "layered_rock"}) {
    const Result<Request> request = read_request(request_of(preset, "{}"), Limits{});
    ASSERT_TRUE(request);
    const double estimated = json::parse(*validate(*request, {}))["estimate"]["bytes"].get<double>();
    const auto made = static_cast<double>(produce(*request, {})->payload.size());
    EXPECT_LT(estimated, 1.5 * made) << preset;
    EXPECT_GT(estimated, made / 1.5) << preset;
  }
}

TEST(Output, EstimatesTheBytesOfATreeBeforeItIsMade) {
  for (const char* preset : {"oak", "dead_tree", "proctree_0", "sculpted_sphere"}) {
    for (const char* output : {R"({"textures":64})", R"({"textures":512})", R"({"textures":"none"})"}) {
      const Result<Request> request = read_request(request_of(preset, output), Limits{});
      ASSERT_TRUE(request) << output;
      const json estimate = json::parse(*validate(*request, {}))["estimate"];
      const auto made = static_cast<double>(produce(*request, {})->payload.size());
      EXPECT_LT(estimate["bytes"].get<double>(), 1.5 * made) << preset << output;
      EXPECT_GT(estimate["bytes"].get<double>(), made / 1.5) << preset << output;
      EXPECT_FALSE(estimate["exact"]);
    }
  }
}

TEST(Output, EstimatesTheBytesOfPlanetsAndLeavesWithinAQuarter) {
  for (const char* preset : {"planetoid", "small_planet", "boulder", "simple_leaf_5_6a", "simple_leaf_5_6c",
                             "sojma_leaf", "alternate_leaf_5_12a", "leafy_birch"}) {
    const Result<Request> request = read_request(request_of(preset, "{}"), Limits{});
    ASSERT_TRUE(request) << preset;
    const Result<Product> product = produce(*request, {});
    ASSERT_TRUE(product) << preset;
    const json estimate = json::parse(*validate(*request, {}))["estimate"];
    const auto bytes = static_cast<double>(product->payload.size());
    EXPECT_LT(estimate["bytes"].get<double>(), 1.25 * bytes) << preset;
    EXPECT_GT(estimate["bytes"].get<double>(), bytes / 1.25) << preset;
    EXPECT_EQ(estimate["triangles"], product->statistics.triangles) << preset;
  }
}

TEST(Output, RefusesABudgetThatCannotBeHeld) {
  EXPECT_THAT(refused("menger_sponge", R"({"max_triangles":10})"), ElementsAre("/output/max_triangles"));
}

TEST(Output, RefusesWhatAFormThatIsNoModelHasNoUseFor) {
  EXPECT_THAT(
      refused(
          "alps",
          R"({"format":"r16","profile":"web","variants":2,"max_triangles":5,"instancing":"merge","tangents":"none"})"),
      UnorderedElementsAre("/output/profile", "/output/variants", "/output/max_triangles",
                           "/output/instancing", "/output/tangents"));
}

TEST(Output, WarnsWhereNothingIsVisible) {
  const Result<Request> seed = read_request(R"({"preset":"oak","parameters":{"age":0}})", Limits{});
  ASSERT_TRUE(seed);
  const Result<Product> product = produce(*seed, {});
  ASSERT_TRUE(product);
  EXPECT_EQ(product->statistics.triangles, 0U);
  EXPECT_EQ(product->statistics.warnings, 1U);
}

TEST(Output, SpeaksOfVariantsInTheEstimate) {
  const auto triangles = [](const std::string& output) {
    const Result<Request> request = read_request(request_of("hutsko_tree", output), Limits{});
    return json::parse(*validate(*request, {}))["estimate"]["triangles"].get<std::uint64_t>();
  };
  EXPECT_EQ(triangles(R"({"variants":5})"), 5 * triangles("{}"));
  EXPECT_EQ(triangles(R"({"max_triangles":77})"), 77U);
}

TEST(Output, WarnsOfABudgetThatGenerationMayRefuse) {
  const auto warned_at = [](const Request& request, const std::string& pointer) {
    const json answer = json::parse(*validate(request, {}));
    for (const json& warning : answer["warnings"]) {
      if (warning["pointer"] == pointer) return true;
    }
    return false;
  };
  struct Case {
    const char *preset, *output, *pointer;
    bool is_refused;
  };
  for (const Case& each :
       std::vector<Case>{{"temple", R"({"max_triangles":12})", "/output/max_triangles", true},
                         {"lava_plain", R"({"max_triangles":12})", "/output/max_triangles", true},
                         {"given_quarter", R"({"max_triangles":500})", "/output/max_triangles", true},
                         {"temple", R"({"lods":[50,20],"format":"zip"})", "/output/lods/0", true},
                         {"temple", R"({"max_triangles":1000000})", "/output/max_triangles", false},
                         {"temple", R"({"lods":[1,0.5],"format":"zip"})", "/output/lods/0", false}}) {
    const Result<Request> request = read_request(request_of(each.preset, each.output), Limits{});
    ASSERT_TRUE(request) << each.preset << each.output;
    const Result<Product> product = produce(*request, {});
    EXPECT_EQ(!product, each.is_refused) << each.preset << each.output;
    if (!product) {
      EXPECT_EQ(product.error().issues.at(0).pointer, each.pointer);
    }
    EXPECT_EQ(warned_at(*request, each.pointer), each.is_refused) << each.preset << each.output;
  }
}

TEST(Output, SpeaksOfTrianglesAloneInTheEstimateAndOfExactOnesWhereTheyAre) {
  const auto estimate = [](const std::string& preset, const std::string& output) {
    const Result<Request> request = read_request(request_of(preset, output), Limits{});
    return json::parse(*validate(*request, {}))["estimate"];
  };
  EXPECT_EQ(estimate("fern_cloud", "{}")["triangles"], 0);
  EXPECT_EQ(estimate("koch_curve_rounds", "{}")["triangles"], 0);
  const json plain = estimate("menger_sponge", "{}"), web = estimate("menger_sponge", R"({"profile":"web"})");
  EXPECT_EQ(plain["exact"], true);
  EXPECT_EQ(web["exact"], false);
  EXPECT_LT(web["bytes"], plain["bytes"]);
}

/// A trunk with a hull, as a generator leaves it.
Model trunk() {
  Model model;
  model.meshes.push_back({"old bark", {}});
  model.meshes.push_back({"hull", {}});
  model.nodes.resize(2);
  model.nodes[0].name = "old bark";
  model.nodes[0].mesh = 0;
  model.nodes[1].name = "hull";
  model.nodes[1].mesh = 1;
  model.nodes[1].collision = CollisionShape::convex;
  return model;
}

TEST(Names, AreThoseOfTheImporter) {
  Model unreal = trunk(), godot = trunk(), core = trunk(), unity = trunk();
  name_for(unreal, OutputProfile::unreal);
  EXPECT_EQ(unreal.nodes[0].name, "old_bark");
  EXPECT_EQ(unreal.nodes[1].name, "UCX_old_bark_00");
  EXPECT_EQ(unreal.meshes[1].name, "UCX_old_bark_00");
  godot.animations.push_back({"wind", {}, {}});
  name_for(godot, OutputProfile::godot);
  EXPECT_EQ(godot.nodes[1].name, "old bark_collision_00-convcolonly");
  EXPECT_EQ(godot.animations[0].name, "wind-loop");
  name_for(core, OutputProfile::core);
  EXPECT_EQ(core.nodes[1].name, "hull");
  unity.nodes[0].lods = {1};
  name_for(unity, OutputProfile::unity);
  EXPECT_EQ(unity.nodes[0].name, "old bark_LOD0");
}

TEST(Names, KeepTheConventionThatWasAskedFor) {
  Model model = trunk();
  model.nodes[1].name = "UCX_bark_01";
  name_for(model, OutputProfile::godot);
  EXPECT_EQ(model.nodes[1].name, "UCX_old bark_01");
  EXPECT_EQ(model.meshes[1].name, "UCX_old bark_01");
}

/// Two trunks, each below a node of its own, as variants stand in one file.
Model two_trunks(const char* hull) {
  Model model;
  for (int i = 0; i < 2; ++i) {
    Model one = trunk();
    one.nodes[1].name = hull;
    one.meshes[0].name = i == 0 ? "bark" : "bark_2";
    for (MeshGroup& group : one.meshes) model.meshes.push_back(std::move(group));
    Node parent;
    parent.name = i == 0 ? "tree_seed_0" : "tree_seed_1";
    model.nodes.push_back(parent);
    for (Node& node : one.nodes) {
      node.parent = 3 * i;
      node.mesh += 2 * i;
      model.nodes.push_back(std::move(node));
    }
  }
  return model;
}

TEST(Names, OfCollisionShapesAreReadByEnginesInEveryVariant) {
  for (const OutputProfile profile : {OutputProfile::core, OutputProfile::unreal, OutputProfile::web}) {
    Model model = two_trunks("UCX_bark_01");
    name_for(model, profile);
    EXPECT_EQ(model.nodes[2].name, "UCX_bark_01");
    EXPECT_EQ(model.nodes[5].name, "UCX_bark_2_01") << "the mesh that it stands for is bark_2";
    EXPECT_EQ(model.meshes[3].name, "UCX_bark_2_01");
  }
  for (const OutputProfile profile : {OutputProfile::core, OutputProfile::godot}) {
    Model model = two_trunks("collision_01-convcolonly");
    name_for(model, profile);
    EXPECT_EQ(model.nodes[2].name, "collision_01-convcolonly");
    EXPECT_EQ(model.nodes[5].name, "collision_02-convcolonly") << "nothing may follow the ending";
  }
}

TEST(Names, EndWhereBlenderEndsThem) {
  Model model = trunk();
  for (Node& node : model.nodes) node.name = std::string(61, 'x') + "äää";
  name_for(model, OutputProfile::blender);
  EXPECT_EQ(model.nodes[0].name, std::string(61, 'x') + "ä");
  EXPECT_EQ(model.nodes[1].name, std::string(61, 'x') + "_2");
}

}  // namespace
}  // namespace seedmesh
