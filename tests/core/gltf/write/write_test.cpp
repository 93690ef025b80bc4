#include "core/gltf/write/write.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <locale>
#include <set>

#include "tests/core/gltf/samples.h"
#include "tests/support/narrow.h"

namespace seedmesh {
namespace {

using namespace samples;
using nlohmann::json;
using ::testing::ElementsAre;

Payload glb_of(Model model) {
  Job fresh = job();
  return write(std::move(model), Container::glb, "seedmesh test", fresh);
}

const tinygltf::Primitive& first_primitive(const tinygltf::Model& model) {
  return model.meshes.at(0).primitives.at(0);
}

std::vector<glm::vec3> positions(const tinygltf::Model& model, std::size_t mesh = 0) {
  return elements<glm::vec3>(model, attribute(model.meshes.at(mesh).primitives.at(0), "POSITION"));
}

TEST(Glb, FramesOneJsonAndOneBinaryChunk) {
  const Payload payload = glb_of(model_of(square(job())));
  const std::string bytes = payload.text();
  std::uint32_t words[5] = {};
  std::memcpy(words, bytes.data(), sizeof words);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(words[1], 2U);
  EXPECT_EQ(words[2], bytes.size());
  EXPECT_EQ(words[3] % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  std::uint32_t bin_size = 0;
  std::memcpy(&bin_size, bytes.data() + 20 + words[3], sizeof bin_size);
  EXPECT_EQ(28 + words[3] + bin_size, bytes.size());
  EXPECT_EQ(json_of(payload)["buffers"][0]["byteLength"], bin_size);
  EXPECT_EQ(payload.size(), bytes.size());
}

TEST(Glb, ReadsBackWithEveryAttribute) {
  const Job fresh = job();
  Mesh mesh = square(fresh);
  mesh.color = Array<glm::u8vec4>(fresh, 4, {255, 128, 0, 255});
  mesh.tangent = Array<glm::vec4>(fresh, 4, {1, 0, 0, 1});
  mesh.uv[1] = Array<glm::vec2>(fresh, 4, {0.25F, 0.75F});
  const tinygltf::Model model = read_glb(glb_of(model_of(std::move(mesh))));
  const tinygltf::Primitive& primitive = first_primitive(model);
  EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
  EXPECT_THAT(positions(model),
              ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)));
  EXPECT_EQ(elements<glm::vec3>(model, attribute(primitive, "NORMAL"))[3], glm::vec3(0, 0, 1));
  EXPECT_EQ(elements<glm::vec4>(model, attribute(primitive, "TANGENT"))[3], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(elements<glm::vec2>(model, attribute(primitive, "TEXCOORD_0"))[2], glm::vec2(1, 1));
  EXPECT_EQ(elements<glm::vec2>(model, attribute(primitive, "TEXCOORD_1"))[2], glm::vec2(0.25F, 0.75F));
  EXPECT_EQ(elements<glm::u8vec4>(model, attribute(primitive, "COLOR_0"))[1], glm::u8vec4(255, 128, 0, 255));
  EXPECT_TRUE(model.accessors.at(static_cast<std::size_t>(attribute(primitive, "COLOR_0"))).normalized);
  EXPECT_THAT(elements<std::uint32_t>(model, primitive.indices), ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Glb, GivesPositionsTheirExactRange) {
  const Job fresh = job();
  Mesh mesh = square(fresh, 0.1F);
  mesh.bounds = {};  // not set: the writer has to look
  const json document = json_of(glb_of(model_of(std::move(mesh))));
  const json& accessor =
      document["accessors"]
              [document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(accessor["min"].dump(), "[0,0,0]");
  EXPECT_EQ(accessor["max"].dump(), "[0.1,0.1,0]");
}

TEST(Glb, TakesIndicesOf16BitsAndPadsThem) {
  const Job fresh = job();
  Mesh one = square(fresh);
  one.index.wide.resize(3);  // three indices of 16 bits end off a multiple of 4
  narrow(one, fresh);
  Mesh two = square(fresh);
  narrow(two, fresh);
  const tinygltf::Model model = read_glb(glb_of(model_of(std::move(one), std::move(two))));
  EXPECT_THAT(elements<std::uint16_t>(model, model.meshes[0].primitives[0].indices), ElementsAre(0, 1, 2));
  EXPECT_THAT(elements<std::uint16_t>(model, model.meshes[1].primitives[0].indices),
              ElementsAre(0, 1, 2, 0, 2, 3));
  for (const auto& accessor : model.accessors) {
    EXPECT_EQ(
        (accessor.byteOffset + model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteOffset) %
            4,
        0U);
  }
}

TEST(Glb, WritesLinesAndPoints) {
  const Job fresh = job();
  Mesh lines;
  lines.topology = Topology::lines;
  lines.position = Array<glm::vec3>(fresh, 2, {1, 2, 3});
  lines.index.wide = Array<std::uint32_t>(fresh, 2, 0);
  lines.index.wide[1] = 1;
  Mesh points;
  points.topology = Topology::points;
  points.position = Array<glm::vec3>(fresh, 3, {4, 5, 6});
  const tinygltf::Model model = read_glb(glb_of(model_of(std::move(lines), std::move(points))));
  EXPECT_EQ(model.meshes[0].primitives[0].mode, TINYGLTF_MODE_LINE);
  EXPECT_EQ(model.meshes[1].primitives[0].mode, TINYGLTF_MODE_POINTS);
  EXPECT_EQ(model.meshes[1].primitives[0].indices, -1);
  EXPECT_EQ(positions(model, 1).size(), 3U);
}

TEST(Glb, PutsSeveralMaterialsOfAMeshIntoPrimitives) {
  const Job fresh = job();
  Model model = model_of(square(fresh));
  model.materials.push_back(paint("leaf"));
  model.meshes[0].primitives.push_back({square(fresh, 2), 1, {}});
  const tinygltf::Model read = read_glb(glb_of(std::move(model)));
  ASSERT_EQ(read.meshes.size(), 1U);
  ASSERT_EQ(read.meshes[0].primitives.size(), 2U);
  EXPECT_EQ(read.materials[static_cast<std::size_t>(read.meshes[0].primitives[1].material)].name, "leaf");
}

TEST(Glb, LetsSmallMeshesShareViewsAndGivesLargeOnesTheirOwn) {
  const Job fresh = job();
  Model model = model_of(square(fresh), square(fresh, 2), square(fresh, 3));
  EXPECT_EQ(read_glb(glb_of(std::move(model))).bufferViews.size(), 3U);  // positions and normals, uv, indices

  Mesh large = square(fresh);
  const std::size_t vertices = 200'000;
  large.position = Array<glm::vec3>(fresh, vertices, {1, 1, 1});
  large.normal = Array<glm::vec3>(fresh, vertices, {0, 0, 1});
  large.uv[0] = {};
  large.bounds = {glm::vec3(1), glm::vec3(1)};
  EXPECT_EQ(read_glb(glb_of(model_of(std::move(large)))).bufferViews.size(),
            3U);  // positions, normals, indices
}

TEST(Glb, PointsIntoTheArraysOfTheMeshInsteadOfCopyingThem) {
  const Job fresh = job();
  Mesh mesh = square(fresh);
  mesh.position = Array<glm::vec3>(fresh, 10'000, {0, 0, 0});
  mesh.bounds = {};
  mesh.normal = {};
  mesh.uv[0] = {};
  const void* address = mesh.position.data();
  const Payload payload = glb_of(model_of(std::move(mesh)));
  const auto& pieces = payload.pieces();
  EXPECT_TRUE(
      std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) { return piece.data() == address; }));
}

TEST(Glb, KeepsWindCoordinatesInSetsTwoAndThree) {
  const Job fresh = job();
  Mesh mesh = square(fresh);
  mesh.uv[2] = Array<glm::vec2>(fresh, 4, {0.5F, 0.5F});
  const tinygltf::Model model = read_glb(glb_of(model_of(std::move(mesh))));
  const tinygltf::Primitive& primitive = first_primitive(model);
  EXPECT_EQ(elements<glm::vec2>(model, attribute(primitive, "TEXCOORD_2"))[0], glm::vec2(0.5F));
  EXPECT_EQ(attribute(primitive, "TEXCOORD_1"), attribute(primitive, "TEXCOORD_0"))
      << "no gap, and no bytes for it";
}

TEST(Glb, WritesSkinsAndAnimations) {
  const tinygltf::Model model = read_glb(glb_of(bending_band(job())));
  ASSERT_EQ(model.skins.size(), 1U);
  EXPECT_THAT(model.skins[0].joints, ElementsAre(1, 2));
  EXPECT_EQ(model.skins[0].skeleton, 1);
  EXPECT_EQ(model.nodes[0].skin, 0);
  EXPECT_EQ(elements<glm::mat4>(model, model.skins[0].inverseBindMatrices)[1][3], glm::vec4(0, -0.5F, 0, 1));
  EXPECT_EQ(elements<glm::u16vec4>(model, attribute(first_primitive(model), "JOINTS_0"))[3].x, 1);
  EXPECT_EQ(elements<glm::vec4>(model, attribute(first_primitive(model), "WEIGHTS_0"))[0],
            glm::vec4(1, 0, 0, 0));

  ASSERT_EQ(model.animations.size(), 1U);
  const tinygltf::Animation& sway = model.animations[0];
  EXPECT_EQ(sway.name, "sway");
  ASSERT_EQ(sway.channels.size(), 2U);
  EXPECT_EQ(sway.channels[0].target_node, 2);
  EXPECT_EQ(sway.channels[0].target_path, "rotation");
  EXPECT_EQ(sway.samplers[0].interpolation, "LINEAR");
  EXPECT_EQ(sway.samplers[1].interpolation, "STEP");
  EXPECT_EQ(sway.samplers[0].input, sway.samplers[1].input) << "channels share key times";
  const tinygltf::Accessor& times = model.accessors[static_cast<std::size_t>(sway.samplers[0].input)];
  EXPECT_THAT(times.minValues, ElementsAre(0.0));
  EXPECT_THAT(times.maxValues, ElementsAre(1.0));
  EXPECT_EQ(elements<glm::vec4>(model, sway.samplers[0].output).size(), 3U);
}

TEST(Glb, WritesMaterialsWithShortNumbersAndWithoutDefaults) {
  Model model = model_of(square(job()));
  model.materials[0].unlit = true;
  const json document = json_of(glb_of(std::move(model)));
  EXPECT_EQ(document["materials"][0].dump(),
            R"({"extensions":{"KHR_materials_unlit":{}},"name":"paint","pbrMetallicRoughness":)"
            R"({"baseColorFactor":[0.5,0.25,0.1,1.0],"metallicFactor":0.0}})");
  EXPECT_EQ(document["extensionsUsed"], json({"KHR_materials_unlit"}));
  EXPECT_FALSE(document.contains("extensionsRequired"));
}

TEST(Glb, WritesTheStrengthOfEmissionAboveOne) {
  Model model = model_of(square(job()));
  model.materials[0].emissive = {4, 2, 0};
  const json bright = json_of(glb_of(std::move(model)));
  EXPECT_EQ(bright["materials"][0]["emissiveFactor"], json({1.0, 0.5, 0.0}));
  EXPECT_EQ(bright["materials"][0]["extensions"].dump(),
            R"({"KHR_materials_emissive_strength":{"emissiveStrength":4.0}})");
  EXPECT_EQ(bright["extensionsUsed"], json({"KHR_materials_emissive_strength"}));
  model = model_of(square(job()));
  model.materials[0].emissive = {1, 0.5F, 0};
  const json dim = json_of(glb_of(std::move(model)));
  EXPECT_EQ(dim["materials"][0]["emissiveFactor"], json({1.0, 0.5, 0.0}));
  EXPECT_FALSE(dim.contains("extensionsUsed"));
}

TEST(Glb, WritesTexturesOnceForEachWrapMode) {
  const Payload glb = glb_of(textured(job()));
  const json document = json_of(glb);
  EXPECT_EQ(document["images"].size(), 2U) << "the unused image is left out";
  EXPECT_EQ(document["textures"].size(), 3U);
  EXPECT_EQ(document["samplers"].size(), 2U);
  EXPECT_EQ(document["materials"][0]["alphaMode"], "MASK");
  EXPECT_EQ(document["materials"][0]["alphaCutoff"], 0.3);
  EXPECT_EQ(document["materials"][0]["occlusionTexture"]["index"],
            document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"]);
  const tinygltf::Model read = read_glb(glb);
  ASSERT_EQ(read.images.size(), 2U);
  EXPECT_EQ(read.images[0].mimeType, "image/png");
  EXPECT_EQ(read.images[0].width, 1) << "decoded by the reader";
}

TEST(Glb, WritesVariantsAndLeavesOutMaterialsWithoutUser) {
  const json document = json_of(glb_of(seasonal(job())));
  EXPECT_EQ(document["materials"].size(), 2U);
  EXPECT_EQ(document["extensions"]["KHR_materials_variants"]["variants"].dump(),
            R"([{"name":"summer"},{"name":"autumn"},{"name":"late_autumn"}])");
  EXPECT_EQ(document["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"].dump(),
            R"([{"material":0,"variants":[0]},{"material":1,"variants":[1,2]}])");
}

TEST(Glb, KeepsTheTreeOfNodesWithTransformsAndExtras) {
  Model model = model_of(square(job()));
  model.nodes.push_back(node("branch", 0, 0));
  model.nodes[1].transform = {{0, 0.1F, 0}, {0.70710678F, 0.70710678F, 0, 0}, {2, 2, 2}};
  model.nodes[1].extras = {{"seed", "18446744073709551615"}, {"rule", R"({"name":"A"})"}};
  model.nodes[1].collision = CollisionShape::capsule;
  const json nodes = json_of(glb_of(std::move(model)))["nodes"];
  EXPECT_EQ(nodes[0], json::parse(R"({"name":"shape0","mesh":0,"children":[1]})"));
  EXPECT_EQ(nodes[1],
            json::parse(R"({"name":"branch","translation":[0,0.1,0],"rotation":[0.70710677,0,0,0.70710677],
    "scale":[2,2,2],"mesh":0,"extras":{"seed":18446744073709551615,"rule":{"name":"A"},"collision":"capsule"}})"));
}

TEST(Glb, WritesInstancesAsNodesThatShareTheMesh) {
  Model model = model_of(square(job()));
  model.nodes[0].name = "window";
  for (int i = 0; i < 3; ++i) {
    Transform& place = model.nodes[0].instances.transforms.emplace_back();
    place.translation.x = static_cast<float>(i);
  }
  model.nodes.push_back(node("window_1", 0));
  const tinygltf::Model read = read_glb(glb_of(std::move(model)));
  EXPECT_EQ(read.meshes.size(), 1U);
  ASSERT_EQ(read.nodes.size(), 5U);
  EXPECT_EQ(read.nodes[0].mesh, -1);
  EXPECT_THAT(read.nodes[0].children, ElementsAre(2, 3, 4));
  EXPECT_EQ(read.nodes[4].mesh, 0);
  EXPECT_THAT(read.nodes[4].translation, ElementsAre(2, 0, 0));
  std::set<std::string> names;
  for (const auto& each : read.nodes) names.insert(each.name);
  EXPECT_EQ(names.size(), 5U) << "names stay unique";
}

TEST(Glb, WritesSeedAndWarningsIntoTheAsset) {
  Model model = model_of(square(job()));
  model.name = "\"asset\":{ is only a name";
  model.extras = {{"seed", "18446744073709551615"}};
  model.warnings = {{"/parameters/angle", "weights sum to 0.9", 0, 0}, {"/parameters/axiom", "odd", 2, 7}};
  const json asset = json_of(glb_of(std::move(model)))["asset"];
  EXPECT_EQ(asset["version"], "2.0");
  EXPECT_EQ(asset["generator"], "seedmesh test");
  EXPECT_EQ(asset["extras"]["seed"], 18446744073709551615U);
  EXPECT_EQ(asset["extras"]["warnings"],
            json::parse(R"([{"pointer":"/parameters/angle","message":"weights sum to 0.9"},
    {"pointer":"/parameters/axiom","message":"odd","line":2,"column":7}])"));
}

TEST(Glb, OfAModelWithoutMeshesIsASceneWithoutLists) {
  const json document = json_of(glb_of(Model{}));
  EXPECT_EQ(
      document,
      json::parse(
          R"({"asset":{"generator":"seedmesh test","version":"2.0"},"scene":0,"scenes":[{"name":"model"}]})"));
}

TEST(Glb, SkipsEmptyMeshesAndTheirNodes) {
  const Job fresh = job();
  Model model = model_of(square(fresh), Mesh{});
  model.nodes[1].instances.transforms.resize(3);
  const tinygltf::Model read = read_glb(glb_of(std::move(model)));
  EXPECT_EQ(read.meshes.size(), 1U);
  ASSERT_EQ(read.nodes.size(), 2U);
  EXPECT_EQ(read.nodes[1].mesh, -1);
}

/// 1.234,5 instead of 1234.5
struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Glb, IsTheSameEveryTimeAndInEveryLocale) {
  const std::string first = glb_of(bending_band(job())).text();
  const std::locale usual = std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
  const std::string second = glb_of(bending_band(job())).text();
  std::locale::global(usual);
  EXPECT_EQ(first, second);
}

TEST(Gltf, ContainsTheBufferOfTheGlbInBase64) {
  Job fresh = job();
  for (int extra = 0; extra < 3; ++extra) {  // so that the buffer ends at every remainder by 3
    Mesh mesh = square(fresh);
    for (int i = 0; i < extra; ++i) mesh.index.wide.push_back(0);
    Mesh copy = square(fresh);
    for (int i = 0; i < extra; ++i) copy.index.wide.push_back(0);
    const tinygltf::Model binary = read_glb(glb_of(model_of(std::move(mesh))));
    const tinygltf::Model text =
        read_gltf(write(model_of(std::move(copy)), Container::gltf, "seedmesh test", fresh).text());
    EXPECT_EQ(text.buffers[0].data, binary.buffers[0].data);
  }
}

TEST(Gltf, ContainsLargeArraysInBase64Too) {
  Job fresh = job();
  Mesh mesh = square(fresh);
  mesh.normal = {};
  mesh.uv[0] = {};
  mesh.position = Array<glm::vec3>(fresh, 700'001, {0, 0, 0});  // more than two blocks of the encoder
  for (std::size_t i = 0; i < mesh.position.size(); ++i) mesh.position[i].x = static_cast<float>(i);
  mesh.bounds = {};
  const tinygltf::Model model =
      read_gltf(write(model_of(std::move(mesh)), Container::gltf, "", fresh).text());
  const std::vector<glm::vec3> read = positions(model);
  ASSERT_EQ(read.size(), 700'001U);
  for (std::size_t i = 0; i < read.size(); ++i) ASSERT_EQ(read[i].x, static_cast<float>(i));
}

/// Writes one file for each sample where the Khronos validator (tests/validator) looks for them.
TEST(Write, LeavesSamplesForTheKhronosValidator) {
  const std::filesystem::path folder = "gltf_samples";
  std::filesystem::create_directories(folder);
  const Job fresh = job();
  std::map<std::string, Model> models = dialect_samples(fresh);
  models["empty"] = Model{};
  Mesh windy = square(fresh);
  windy.uv[3] = Array<glm::vec2>(fresh, 4, {0, 1});
  windy.color = Array<glm::u8vec4>(fresh, 4, {1, 2, 3, 4});
  narrow(windy, fresh);
  models["windy"] = model_of(std::move(windy));
  Mesh points;
  points.topology = Topology::points;
  points.position = Array<glm::vec3>(fresh, 3, {0.1F, 0.2F, 0.3F});
  models["points"] = model_of(std::move(points));
  for (auto& [name, model] : models) {
    const std::filesystem::path file = folder / (name + ".glb");
    std::ofstream(file, std::ios::binary) << glb_of(std::move(model)).text();
    EXPECT_GT(std::filesystem::file_size(file), 100U);
  }
  for (auto& [name, model] : dialect_samples(fresh)) {
    Job each = job();
    const WriteOptions options{Container::glb, "seedmesh test", {true, true, true}};
    std::ofstream(folder / (name + "_web.glb"), std::ios::binary)
        << write(std::move(model), options, each).text();
  }
  for (auto& [name, model] : dialect_samples(fresh)) {
    Job each = job();
    const WriteOptions options{Container::glb, "seedmesh test", {false, true, true}};
    std::ofstream(folder / (name + "_unity.glb"), std::ios::binary)
        << write(std::move(model), options, each).text();
  }
  Job text_job = job();
  const std::filesystem::path file = folder / "textured.gltf";
  std::ofstream(file, std::ios::binary) << write(textured(text_job), Container::gltf, "", text_job).text();
  EXPECT_GT(std::filesystem::file_size(file), 100U);
}

}  // namespace
}  // namespace seedmesh
