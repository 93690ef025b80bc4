/// Equal names mean equal content, in all models; and a model says where it comes from.
#include <gmock/gmock.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/base64url.h"
#include "core/base/deflate.h"
#include "core/pipeline.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::MatchesRegex;

struct File {
  json document;
  std::string bin;
};

File file_of(const Product& product) {
  const std::string bytes = product.payload.text();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  const std::size_t bin = 20 + std::size_t{size} + 8;
  return {json::parse(bytes.substr(20, size)), bin < bytes.size() ? bytes.substr(bin) : std::string()};
}

std::optional<File> made(const Result<Request>& request) {
  const Result<Product> product = request ? produce(*request, {}) : Result<Product>(request.error());
  if (product) return file_of(*product);
  ADD_FAILURE() << product.error().issues.front().pointer << ": " << product.error().issues.front().message;
  return std::nullopt;
}

std::optional<File> made(const std::string& body) { return made(read_request(body, Limits{})); }

std::string view_bytes(const File& file, std::size_t view) {
  const json& row = file.document["bufferViews"][view];
  return file.bin.substr(row.value("byteOffset", std::size_t{0}), row["byteLength"].get<std::size_t>());
}

std::string image_content(const File& file, std::size_t image) {
  const json& row = file.document["images"][image];
  return row["mimeType"].get<std::string>() + view_bytes(file, row["bufferView"]);
}

/// Replaces texture numbers by the images and samplers behind them.
void resolve_textures(json& value, const File& file) {
  if (!value.is_structured()) return;
  if (value.is_object() && value.contains("index")) {
    const json& texture = file.document["textures"][value["index"].get<std::size_t>()];
    value["sampler"] = texture.contains("sampler")
                           ? file.document["samplers"][texture["sampler"].get<std::size_t>()]
                           : json();
    value["index"] = std::hash<std::string>()(image_content(file, texture["source"]));
  }
  for (json& each : value) resolve_textures(each, file);
}

std::string material_content(const File& file, std::size_t number) {
  json material = file.document["materials"][number];
  material.erase("name");
  resolve_textures(material, file);
  return material.dump();
}

/// The bytes of an accessor, element by element.
std::string accessor_content(const File& file, std::size_t number) {
  const json& row = file.document["accessors"][number];
  static const std::map<std::string, std::size_t> lanes = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const int type = row["componentType"];
  const std::size_t width = type == 5121 ? 1 : type == 5123 || type == 5122 ? 2 : 4;
  const std::size_t element = width * lanes.at(row["type"]);
  const json& view = file.document["bufferViews"][row["bufferView"].get<std::size_t>()];
  const std::size_t stride = view.value("byteStride", element);
  std::size_t at = view.value("byteOffset", std::size_t{0}) + row.value("byteOffset", std::size_t{0});
  std::string bytes = std::to_string(type) + row["type"].get<std::string>();
  for (std::size_t i = 0; i < row["count"].get<std::size_t>(); ++i, at += stride)
    bytes.append(file.bin, at, element);
  return bytes;
}

std::string mesh_content(const File& file, const json& mesh) {
  std::string content;
  for (json primitive : mesh["primitives"]) {
    for (auto& [name, accessor] : primitive["attributes"].items())
      content += name + accessor_content(file, accessor);
    if (primitive.contains("indices")) content += accessor_content(file, primitive["indices"]);
    if (primitive.contains("material")) content += material_content(file, primitive["material"]);
    content += std::to_string(primitive.value("mode", 4));
  }
  return content;
}

/// What each name meant first, by kind of the named thing.
class Meanings {
 public:
  void add(const std::string& kind, const std::string& name, const std::string& content) {
    const std::size_t hash = std::hash<std::string>()(content);
    const auto [known, is_new] = first_.try_emplace(kind + ' ' + name, hash);
    EXPECT_TRUE(is_new || known->second == hash) << kind << " " << name << " has several contents";
  }

 private:
  std::map<std::string, std::size_t> first_;
};

void add_all(const File& file, Meanings& meanings) {
  const json& document = file.document;
  for (std::size_t i = 0; i < document.value("images", json::array()).size(); ++i)
    meanings.add("image", document["images"][i]["name"], image_content(file, i));
  for (std::size_t i = 0; i < document.value("materials", json::array()).size(); ++i)
    meanings.add("material", document["materials"][i]["name"], material_content(file, i));
  for (const json& mesh : document.value("meshes", json::array()))
    meanings.add("mesh", mesh["name"], mesh_content(file, mesh));
  for (const json& root : document["scenes"][0].value("nodes", json::array()))
    meanings.add("root", document["nodes"][root.get<std::size_t>()]["name"], file.bin);
}

TEST(Names, MeanOneContentInAllPresetsAndTwoSeeds) {
  Meanings meanings;
  for (const PresetInfo& preset : presets()) {
    for (const char* seed : {"3", "4"}) {
      const auto request = read_preset(
          preset.name, {{"seed", seed}, {"output.textures", "32"}, {"output.format", "glb"}}, Limits{});
      ASSERT_TRUE(request);
      if (const auto file = made(*request)) add_all(*file, meanings);
    }
  }
}

TEST(Names, AreThePresetsWithTheSeedOrAHash) {
  const auto name = [](const std::string& preset, const Overrides& overrides) {
    return (*read_preset(preset, overrides, Limits{}))->name();
  };
  EXPECT_EQ(name("oak", {}), "oak");
  EXPECT_EQ(name("oak", {{"seed", "3"}}), "oak_3");
  EXPECT_EQ(name("oak", {{"seed", "3"}, {"output.format", "zip"}}), "oak_3");
  EXPECT_THAT(name("oak", {{"output.profile", "unity"}}), MatchesRegex("oak_[a-f][0-9a-f]{7}"));
  EXPECT_EQ(name("oak", {{"output.name", "villa"}, {"seed", "9"}}), "villa");
  EXPECT_EQ(read_request(R"({"preset":"oak","seed":3})", Limits{})->name(), "oak_3");
  EXPECT_THAT(read_request(R"({"generator":"tree"})", Limits{})->name(),
              MatchesRegex("tree_[a-f][0-9a-f]{7}"));
}

TEST(Names, OfUnchangedPartsStayWhereOtherPartsChange) {
  const auto plain = made(R"({"preset":"oak","output":{"textures":32}})");
  const auto other = made(R"({"preset":"oak","seed":8,"output":{"textures":32}})");
  ASSERT_TRUE(plain && other);
  EXPECT_EQ(plain->document["materials"], other->document["materials"]);
  EXPECT_NE(plain->document["meshes"][0]["name"], other->document["meshes"][0]["name"]);
}

TEST(Names, OfTheRequestThatAreNotOnesAreRefused) {
  for (const std::string name : {"", "a b", "a/b", "ä"}) {
    const auto request = read_request(R"({"preset":"oak","output":{"name":")" + name + R"("}})", Limits{});
    ASSERT_FALSE(request);
    EXPECT_EQ(request.error().issues.front().pointer, "/output/name");
  }
}

TEST(Provenance, IsInTheAssetTheSceneAndTheRoot) {
  const auto request = read_request(R"({"preset":"menger_sponge","seed":"18446744073709551615"})", Limits{});
  const auto file = made(request);
  ASSERT_TRUE(file);
  const json& document = file->document;
  const json& scene = document["scenes"][0];
  const json& root = document["nodes"][scene["nodes"][0].get<std::size_t>()];
  for (const json& extras : {document["asset"]["extras"], scene["extras"], root["extras"]}) {
    EXPECT_EQ(extras["engine"], std::string(engine_version()));
    EXPECT_EQ(extras["generator"], "fractal");
    EXPECT_EQ(extras["seed"], "18446744073709551615");
    EXPECT_EQ(extras["preset"], "menger_sponge");
    EXPECT_EQ(extras["request"], request->canonical());
    EXPECT_THAT(extras["permalink"].get<std::string>(), MatchesRegex("/v1/models/[A-Za-z0-9_-]+\\.glb"));
  }
  const std::string link = root["extras"]["permalink"];
  const auto text = inflate_raw(*from_base64url(link.substr(11, link.size() - 15)), 100'000);
  json carried = json::parse(*text);
  EXPECT_EQ(carried["engine"], std::string(engine_version()));
  carried.erase("engine");
  EXPECT_EQ(carried, json::parse(request->canonical()));
}

TEST(Provenance, SentAgainGivesTheSameBytes) {
  const auto request = read_request(R"({"preset":"oak","seed":3,"output":{"textures":32}})", Limits{});
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product);
  const json document = file_of(*product).document;
  const std::string again =
      document["nodes"][document["scenes"][0]["nodes"][0].get<std::size_t>()]["extras"]["request"];
  EXPECT_EQ(produce(*read_request(again, Limits{}), {})->payload.text(), product->payload.text());
}

TEST(Provenance, IsLeftOut) {
  const auto file = made(R"({"preset":"menger_sponge","output":{"provenance":"none"}})");
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->document["asset"].contains("extras"));
  EXPECT_FALSE(file->document["scenes"][0].contains("extras"));
  EXPECT_FALSE(file->document["nodes"][0].contains("extras"));
}

TEST(Provenance, OfALongRequestIsItsHash) {
  std::string axiom = "F";
  while (axiom.size() < 20'000) axiom += "+F";
  const auto file = made(R"({"generator":"lsystem","parameters":{"axiom":")" + axiom + R"("}})");
  ASSERT_TRUE(file);
  const json& extras = file->document["asset"]["extras"];
  EXPECT_FALSE(extras.contains("request"));
  EXPECT_FALSE(extras.contains("permalink"));
  EXPECT_THAT(extras["request_hash"].get<std::string>(), MatchesRegex("[0-9a-f]{16}"));
}

TEST(Requests, MayNameTheirSchema) {
  const auto plain = read_request(R"({"preset":"oak"})", Limits{});
  const auto with =
      read_request(R"({"$schema":"https://x.test/v1/schemas/request","preset":"oak"})", Limits{});
  ASSERT_TRUE(with);
  EXPECT_EQ(with->canonical(), plain->canonical());
  const auto wrong = read_request(R"({"$schema":3,"preset":"oak"})", Limits{});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().issues.front().pointer, "/$schema");
}

TEST(Scenes, StoreEqualImagesOnce) {
  const auto file = made(R"({"preset":"village_edge","output":{"textures":32}})");
  ASSERT_TRUE(file);
  std::map<std::string, int> contents;
  for (std::size_t i = 0; i < file->document["images"].size(); ++i) ++contents[image_content(*file, i)];
  for (const auto& [content, times] : contents) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace seedmesh
