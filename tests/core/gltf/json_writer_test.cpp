#include "core/gltf/json_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include <vector>

#include "core/base/rng.h"
#include "core/gltf/write/materials.h"

namespace seedmesh::gltf {
namespace {

std::string number(float value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string decimal(float value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

std::string quoted(std::string_view value) {
  std::string text;
  append_string(text, value);
  return text;
}

TEST(JsonWriter, PrintsDecimalsInTheFormInWhichTheLibraryPrintsDoubles) {
  EXPECT_EQ(decimal(1.0F), "1.0");
  EXPECT_EQ(decimal(-0.0F), "0.0");
  EXPECT_EQ(decimal(0.4F), "0.4");
  EXPECT_EQ(decimal(1e-4F), "0.0001");
  EXPECT_EQ(decimal(100'000.0F), "100000.0");
  std::uint32_t bits = 12345;
  for (int i = 0; i < 20'000; ++i) {
    bits = bits * 1'664'525U + 1'013'904'223U;
    const auto value = std::bit_cast<float>(bits);
    if (!std::isfinite(value)) continue;
    // Which now and then has digits more than are needed.
    const std::string own = decimal(value), other = nlohmann::json(shortest(value)).dump();
    EXPECT_LE(own.size(), other.size());
    EXPECT_EQ(nlohmann::json::parse(own).get<double>(), nlohmann::json::parse(other).get<double>());
    EXPECT_EQ(own.find('e') == std::string::npos, other.find('e') == std::string::npos);
    EXPECT_TRUE(nlohmann::json::parse(own).is_number_float());
  }
}

/// The material as JSON; textures have the numbers of their images.
std::string described(const Material& material) {
  std::string text;
  append_material(text, material, [](const TextureUse& use) { return use.texture; });
  return text;
}

TEST(Materials, LeaveOutWhatGltfTakesAsDefault) {
  Material material;
  material.base_color = {1, 1, 1, 1};
  material.metallic = material.roughness = 1;
  EXPECT_EQ(described(material), "{}");
  material.name = "a \"b\"";
  material.roughness = 0.5F;
  EXPECT_EQ(described(material), R"({"name":"a \"b\"","pbrMetallicRoughness":{"roughnessFactor":0.5}})");
}

TEST(Materials, HaveTheirMembersByName) {
  Material material;
  material.name = "all";
  material.base_color = {0.25F, 1, 0, 1};
  material.metallic = 0;
  material.roughness = 1;
  material.emissive = {0, 0, 2};
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.4F;
  material.double_sided = true;
  material.unlit = true;
  material.base_color_texture = {0, 1, true};
  material.metallic_roughness_texture = material.occlusion_texture = {1, 0, true};
  material.normal_texture = {2, 0, true};
  material.emissive_texture = {3, 0, true};
  EXPECT_EQ(described(material),
            R"({"alphaCutoff":0.4,"alphaMode":"MASK","doubleSided":true,"emissiveFactor":[0.0,0.0,1.0],)"
            R"("emissiveTexture":{"index":3},"extensions":{"KHR_materials_emissive_strength":)"
            R"({"emissiveStrength":2.0},"KHR_materials_unlit":{}},"name":"all",)"
            R"("normalTexture":{"index":2},"occlusionTexture":{"index":1},)"
            R"("pbrMetallicRoughness":{"baseColorFactor":[0.25,1.0,0.0,1.0],)"
            R"("baseColorTexture":{"index":0,"texCoord":1},"metallicFactor":0.0,)"
            R"("metallicRoughnessTexture":{"index":1}}})");
}

TEST(Materials, DescribeTheLightThatPassesThroughLeaves) {
  Material material;
  material.metallic = 1;
  material.roughness = 1;
  material.base_color = {0.5F, 0.5F, 0.5F, 1};
  material.base_color_texture = {4, 0, true};
  material.transmission = 0.25F;
  material.transmission_color = {1, 1, 0.5F};
  material.specular = 0.5F;
  EXPECT_EQ(
      described(material),
      R"({"extensions":{"KHR_materials_diffuse_transmission":{)"
      R"("diffuseTransmissionColorFactor":[0.5,0.5,0.25],"diffuseTransmissionColorTexture":{"index":4},)"
      R"("diffuseTransmissionFactor":0.25},"KHR_materials_specular":{"specularFactor":0.5}},)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1.0],"baseColorTexture":{"index":4}}})");
}

TEST(Materials, HaveAColourOfReflections) {
  Material material;
  material.metallic = 1;
  material.roughness = 1;
  material.specular_color = {1, 0.5F, 0.25F};
  EXPECT_EQ(described(material),
            R"({"extensions":{"KHR_materials_specular":{"specularColorFactor":[1.0,0.5,0.25]}}})");
  material.specular = 0.5F;
  EXPECT_EQ(
      described(material),
      R"({"extensions":{"KHR_materials_specular":{"specularColorFactor":[1.0,0.5,0.25],"specularFactor":0.5}}})");
}

TEST(JsonWriter, SetsCommasBetweenMembersAndValues) {
  std::string text;
  JsonWriter json(text);
  json.object([&] {
    json.member("name", "a:[{");
    json.member("count", 3);
    json.values("range", std::vector<float>{0.5F, -1});
    json.array("list", [&] {
      json.object([] {});
      json.value(true);
    });
    json.list("nothing", "");
    json.list("numbers", "1,2");
    json.key("raw");
    json.json("null");
  });
  EXPECT_EQ(text,
            R"({"name":"a:[{","count":3,"range":[0.5,-1],"list":[{},true],"numbers":[1,2],"raw":null})");
}

TEST(JsonWriter, ContinuesAListWithoutBrackets) {
  std::string list;
  for (int i = 0; i < 3; ++i) JsonWriter(list).value(i);
  EXPECT_EQ(list, "0,1,2");
}

TEST(JsonWriter, PrintsFloatsAsShortAsTheyReadBack) {
  EXPECT_EQ(number(0.1F), "0.1");
  EXPECT_EQ(number(1.0F), "1");
  EXPECT_EQ(number(-2.5F), "-2.5");
  EXPECT_EQ(number(16'777'216.0F), "16777216");
  EXPECT_EQ(number(1e-7F), "1e-07");
}

TEST(JsonWriter, PrintsADoubleInFull) {
  std::string text;
  append_number(text, static_cast<double>(22.521484375F));
  EXPECT_EQ(text, "22.521484375");
  text.clear();
  append_number(text, 22.521484375F);
  EXPECT_EQ(text, "22.521484");  // the shortest that reads back as the same float
}

TEST(JsonWriter, HasNoNegativeZero) { EXPECT_EQ(number(-0.0F), "0"); }

TEST(JsonWriter, GivesEveryFloatBackBothAsTextAndAsDouble) {
  Rng rng = Rng::of_seed(1).at("floats");
  for (int i = 0; i < 20'000; ++i) {
    const auto bits = static_cast<std::uint32_t>(rng.next());
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(nlohmann::json::parse(number(value)).get<float>(), value);
    EXPECT_EQ(static_cast<float>(shortest(value)), value);
  }
  const float largest = std::numeric_limits<float>::max();
  EXPECT_EQ(static_cast<float>(shortest(largest)), largest);
}

TEST(JsonWriter, EscapesCharactersForJson) {
  EXPECT_EQ(quoted("plain name"), R"("plain name")");
  EXPECT_EQ(nlohmann::json::parse(quoted("quote\" back\\slash \n \x01 é 木")),
            "quote\" back\\slash \n \x01 é 木");
}

TEST(JsonWriter, ReplacesBytesThatAreNoText) {
  EXPECT_EQ(nlohmann::json::parse(quoted("a\xFFz")), "a\uFFFDz");
}

}  // namespace
}  // namespace seedmesh::gltf
