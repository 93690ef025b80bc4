/// Levels of detail by their triangles, images as WebP, bodies for Godot, and where growth begins.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Made {
  json document;
  std::string bin;
  std::vector<Warning> warnings;
  std::vector<Issue> issues;  ///< of a refused request
};

Made made(const std::string& preset, const std::string& output) {
  Made result;
  const Result<Request> request =
      read_request(R"({"preset":")" + preset + R"(","output":)" + output + "}", Limits{});
  if (!request) {
    result.issues = request.error().issues;
    return result;
  }
  const Result<Product> product = produce(*request, {});
  if (!product) {
    result.issues = product.error().issues;
    return result;
  }
  const std::string bytes = product->payload.text();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  result.document = json::parse(bytes.substr(20, size));
  result.bin = bytes.substr(28 + size);
  result.warnings = product->warnings;
  return result;
}

/// Of a node and its children.
std::size_t triangles_of(const json& document, const json& node) {
  std::size_t corners = 0;
  if (node.contains("mesh")) {
    for (const json& primitive : document["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
      corners += document["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
  }
  std::size_t triangles = corners / 3;
  for (const json& child : node.value("children", json::array()))
    triangles += triangles_of(document, document["nodes"][child.get<std::size_t>()]);
  return triangles;
}

/// Triangles of each level of a file with MSFT_lod.
std::vector<std::size_t> levels_of(const json& document) {
  std::vector<std::size_t> triangles;
  for (const json& node : document["nodes"]) {
    if (!node.contains("extensions") || !node["extensions"].contains("MSFT_lod")) continue;
    const json& ids = node["extensions"]["MSFT_lod"]["ids"];
    triangles.resize(std::max(triangles.size(), ids.size() + 1), 0);
    triangles[0] += triangles_of(document, node);
    for (std::size_t i = 0; i < ids.size(); ++i)
      triangles[i + 1] += triangles_of(document, document["nodes"][ids[i].get<std::size_t>()]);
  }
  return triangles;
}

TEST(ListedLevels, HaveTheSharesOfTheTriangles) {
  for (const char* preset : {"oak", "pine", "abop_1_24f"}) {
    const Made result = made(preset, R"({"profile":"unity","lods":[1,0.5,0.15,0.03],"textures":"none"})");
    ASSERT_TRUE(result.issues.empty()) << preset << ": " << result.issues.front().message;
    const std::vector<std::size_t> levels = levels_of(result.document);
    ASSERT_EQ(levels.size(), 4U) << preset;
    const auto whole = static_cast<double>(levels[0]);
    const double shares[] = {1, 0.5, 0.15, 0.03};
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_LE(static_cast<double>(levels[i]), shares[i] * whole * 1.02) << preset << " " << i;
      EXPECT_GE(static_cast<double>(levels[i]), shares[i] * whole * 0.8) << preset << " " << i;
    }
  }
}

TEST(ListedLevels, HaveTheNumbersOfTriangles) {
  const Made result = made("oak", R"({"profile":"unity","lods":[20000,5000,800],"textures":"none"})");
  const std::vector<std::size_t> levels = levels_of(result.document);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_LE(levels[0], 20'000U);
  EXPECT_LE(levels[1], 5'000U);
  EXPECT_LE(levels[2], 816U);
  EXPECT_GE(levels[2], 640U);
}

TEST(ListedLevels, BeginWhereTheScreenShowsAsManyTrianglesInAnArea) {
  const Made result = made("oak", R"({"profile":"unity","lods":[1,0.25,0.04],"textures":"none"})");
  std::size_t checked = 0;
  for (const json& node : result.document["nodes"]) {
    if (!node.contains("extensions")) continue;
    const json& screen = node["extras"]["MSFT_screencoverage"];
    ASSERT_EQ(screen.size(), 3U);
    EXPECT_NEAR(screen[0].get<double>(), 0.5, 0.02);
    EXPECT_NEAR(screen[1].get<double>(), 0.2, 0.02);
    EXPECT_EQ(screen[2], 0);
    ++checked;
  }
  EXPECT_EQ(checked, 1U);  // the root
}

TEST(ListedLevels, AreFollowedByAnImpostor) {
  const Made result = made("bush", R"({"profile":"unity","lods":[1,0.1],"impostor":true,"textures":64})");
  const std::vector<std::size_t> levels = levels_of(result.document);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[2], 12U);
}

TEST(ListedLevels, AreRefusedWhereTheyDoNotFall) {
  const auto pointers = [](const char* list) {
    std::vector<std::string> found;
    for (const Issue& issue : made("oak", R"({"format":"zip","lods":)" + std::string(list) + "}").issues)
      found.push_back(issue.pointer);
    return found;
  };
  EXPECT_THAT(pointers("[1, 0.2, 0.2]"), ElementsAre("/output/lods/2"));
  EXPECT_THAT(pointers("[900, 1000]"), ElementsAre("/output/lods/1"));
  EXPECT_THAT(pointers("[1, 2.5]"), ElementsAre("/output/lods/1"));
  EXPECT_THAT(pointers("[1, 0]"), ElementsAre("/output/lods/1"));
  EXPECT_THAT(pointers("[]"), ElementsAre("/output/lods"));
  EXPECT_THAT(pointers("[1,0.9,0.8,0.7,0.6,0.5,0.4,0.3,0.2]"), ElementsAre("/output/lods"));
  EXPECT_THAT(pointers("[1, \"half\"]"), ElementsAre("/output/lods/1"));
}

TEST(ListedLevels, NeedAFormatThatContainsThem) {
  const Made result = made("oak", R"({"lods":[1,0.5]})");
  ASSERT_EQ(result.issues.size(), 1U);
  EXPECT_EQ(result.issues[0].pointer, "/output/lods");
  EXPECT_THAT(result.issues[0].message, HasSubstr("found 2 levels"));
  EXPECT_TRUE(made("bush", R"({"lods":[1],"textures":"none"})").issues.empty());
}

TEST(ListedLevels, SayWhatTheyCannotReach) {
  const Made tower = made("cga_office", R"({"profile":"unity","lods":[1,0.5,0.1,0.0001],"textures":"none"})");
  if (tower.issues.empty()) {
    EXPECT_THAT(tower.warnings, Contains(testing::Field(&Warning::pointer, HasSubstr("/output/lods"))));
  } else {
    EXPECT_EQ(tower.issues[0].pointer, "/output/lods");
  }
  const Made budget = made("menger_sponge", R"({"lods":[3],"textures":"none"})");
  ASSERT_EQ(budget.issues.size(), 1U);
  EXPECT_EQ(budget.issues[0].pointer, "/output/lods/0");
}

TEST(ImageFormat, IsWebpInTheProfileWebAndRequired) {
  const Made web = made("birch", R"({"profile":"web","textures":64})");
  EXPECT_THAT(web.document["extensionsRequired"], Contains("EXT_texture_webp"));
  for (const json& image : web.document["images"]) EXPECT_EQ(image["mimeType"], "image/webp");
  for (const json& texture : web.document["textures"]) {
    EXPECT_FALSE(texture.contains("source"));
    EXPECT_TRUE(texture["extensions"]["EXT_texture_webp"].contains("source"));
  }
  const Made png = made("birch", R"({"profile":"web","textures":64,"image_format":"png"})");
  EXPECT_THAT(png.document["extensionsUsed"], Not(Contains("EXT_texture_webp")));
}

TEST(ImageFormat, ContainsBothForReadersOfEither) {
  const Made both = made("birch", R"({"textures":64,"image_format":"both"})");
  EXPECT_THAT(both.document["extensionsUsed"], Contains("EXT_texture_webp"));
  EXPECT_FALSE(both.document.contains("extensionsRequired"));
  const json& images = both.document["images"];
  for (const json& texture : both.document["textures"]) {
    EXPECT_EQ(images[texture["source"].get<std::size_t>()]["mimeType"], "image/png");
    const json& other = images[texture["extensions"]["EXT_texture_webp"]["source"].get<std::size_t>()];
    EXPECT_EQ(other["mimeType"], "image/webp");
    const json& view = both.document["bufferViews"][other["bufferView"].get<std::size_t>()];
    EXPECT_EQ(both.bin.substr(view.value("byteOffset", std::size_t{0}) + 8, 4), "WEBP");
  }
  std::set<std::string> names;
  for (const json& image : images) names.insert(image["name"].get<std::string>());
  EXPECT_EQ(names.size(), images.size());
}

TEST(ImageFormat, IsRefusedWhereNoReaderTakesIt) {
  for (const char* output :
       {R"({"profile":"unity","image_format":"webp"})", R"({"profile":"unreal","image_format":"webp"})",
        R"({"textures":"links","image_format":"both"})"}) {
    const Made result = made("birch", output);
    ASSERT_EQ(result.issues.size(), 1U) << output;
    EXPECT_EQ(result.issues[0].pointer, "/output/image_format");
  }
  EXPECT_TRUE(made("birch", R"({"textures":"links","profile":"web"})").issues.empty());
}

TEST(Bodies, AreShapesOfOneBodyForGodot) {
  const Made godot = made("oak", R"({"profile":"godot","collision":"godot","textures":"none"})");
  const json& shapes = godot.document["extensions"]["OMI_physics_shape"]["shapes"];
  EXPECT_GT(shapes.size(), 3U);
  EXPECT_THAT(godot.document["extensionsUsed"], Contains("GODOT_single_root"));
  EXPECT_FALSE(godot.document.contains("extensionsRequired"));
  std::size_t bodies = 0;
  std::vector<bool> used(shapes.size(), false);
  for (const json& node : godot.document["nodes"]) {
    if (!node.contains("extensions") || !node["extensions"].contains("OMI_physics_body")) continue;
    const json& body = node["extensions"]["OMI_physics_body"];
    if (body.contains("motion")) {
      ++bodies;
      EXPECT_EQ(body["motion"]["type"], "static");
    }
    if (!body.contains("collider")) continue;
    EXPECT_FALSE(node.contains("mesh")) << "a viewer would show it";
    used[body["collider"]["shape"].get<std::size_t>()] = true;
  }
  EXPECT_EQ(bodies, 1U);
  EXPECT_THAT(used, Not(Contains(false)));
  for (const json& shape : shapes)
    EXPECT_LT(shape["convex"]["mesh"].get<std::size_t>(), godot.document["meshes"].size());
}

TEST(Growth, BeginsVisiblyWhereTheFirstFrameIsTheRestPose) {
  const auto first_scale = [](const char* profile) {
    const Made result = made("growing_tree", R"({"animation":"growth","textures":"none","profile":")" +
                                                 std::string(profile) + "\"}");
    const json& document = result.document;
    double largest = 0;
    for (const json& sampler : document["animations"][0]["samplers"]) {
      const json& accessor = document["accessors"][sampler["output"].get<std::size_t>()];
      const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
      float value = 0;
      std::memcpy(&value,
                  result.bin.data() + view.value("byteOffset", std::size_t{0}) +
                      accessor.value("byteOffset", std::size_t{0}),
                  sizeof value);
      largest = std::max(largest, static_cast<double>(value));
    }
    return largest;
  };
  EXPECT_LT(first_scale("core"), 0.01);
  // A bone that is born at the start has 1 - 0.7 * 0.7 of its size; others are relative to their parents.
  EXPECT_GE(first_scale("blender"), 1 - 0.7 * 0.7 - 0.01);
}

TEST(Coordinates, ExistOnEverySurfaceOfModelsForEngines) {
  for (const char* preset : {"menger_sponge", "cga_courtyard", "vicsek_star"}) {
    const Made result = made(preset, R"({"textures":"none"})");
    ASSERT_TRUE(result.issues.empty()) << preset;
    for (const json& mesh : result.document["meshes"]) {
      for (const json& primitive : mesh["primitives"]) {
        const bool is_surface = primitive.value("mode", 4) == 4;
        EXPECT_TRUE(!is_surface || primitive["attributes"].contains("TEXCOORD_0")) << preset;
      }
    }
  }
}

}  // namespace
}  // namespace seedmesh
