/// What a file says in extensions reads back as what was written.
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <cmath>

#include "tests/core/gltf/samples.h"

namespace seedmesh {
namespace {

using namespace samples;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;
using ::testing::UnorderedElementsAre;

Payload written(Model model, Dialect dialect, Container container = Container::glb) {
  Job fresh = job();
  return write(std::move(model), {container, "seedmesh test", dialect}, fresh);
}

constexpr Dialect compressed = {.compressed = true};
constexpr Dialect quantized = {.quantized = true};
constexpr Dialect gpu = {.gpu_instances = true};
constexpr Dialect lods = {.lods_inside = true};

/// A compressed GLB with its views decoded.
class Decoded {
 public:
  explicit Decoded(const Payload& glb) : json_(json_of(glb)), bytes_(glb.text()) {
    bin_ = bytes_.find("BIN", 20) + 4;
  }

  const json& document() const { return json_; }
  const json& mesh(std::size_t number) const { return json_["meshes"][number]["primitives"][0]; }
  const json& accessor(const json& number) const { return json_["accessors"][number.get<std::size_t>()]; }

  /// Bytes of a view as they are after decoding and filtering.
  std::vector<unsigned char> view(std::size_t number) const {
    const json& extension = json_["bufferViews"][number]["extensions"]["EXT_meshopt_compression"];
    const auto count = extension["count"].get<std::size_t>(),
               stride = extension["byteStride"].get<std::size_t>();
    const auto* data = reinterpret_cast<const unsigned char*>(bytes_.data()) + bin_ +
                       extension["byteOffset"].get<std::size_t>();
    const auto size = extension["byteLength"].get<std::size_t>();
    std::vector<unsigned char> out(count * stride);
    const std::string mode = extension["mode"];
    int fault = 0;
    if (mode == "ATTRIBUTES") fault = meshopt_decodeVertexBuffer(out.data(), count, stride, data, size);
    if (mode == "TRIANGLES") fault = meshopt_decodeIndexBuffer(out.data(), count, stride, data, size);
    if (mode == "INDICES") fault = meshopt_decodeIndexSequence(out.data(), count, stride, data, size);
    EXPECT_EQ(fault, 0);
    const std::string filter = extension.value("filter", "NONE");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
    return out;
  }

  template <class T>
  std::vector<T> elements(const json& number) const {
    const json& row = accessor(number);
    const std::vector<unsigned char> bytes = view(row["bufferView"].get<std::size_t>());
    std::vector<T> values(row["count"].get<std::size_t>());
    std::memcpy(values.data(), bytes.data() + row.value("byteOffset", std::size_t{0}),
                values.size() * sizeof(T));
    return values;
  }

  /// Positions of a mesh as a node places them.
  std::vector<glm::vec3> positions(std::size_t mesh_number, std::size_t node) const {
    const json& at = json_["nodes"][node];
    const auto step = at["scale"][0].get<float>();
    glm::vec3 origin(0);
    for (int axis = 0; at.contains("translation") && axis < 3; ++axis)
      origin[axis] = at["translation"][static_cast<std::size_t>(axis)];
    std::vector<glm::vec3> all;
    for (const glm::u16vec4& p : elements<glm::u16vec4>(mesh(mesh_number)["attributes"]["POSITION"]))
      all.push_back(origin + step * glm::vec3(p));
    return all;
  }

 private:
  json json_;
  std::string bytes_;
  std::size_t bin_;
};

/// A ball of unit normals with coordinates that leave 0..1.
Mesh ball(const Job& job, float radius, glm::vec3 middle) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  constexpr std::uint32_t around = 24, up = 12;
  for (std::uint32_t i = 0; i <= up; ++i) {
    for (std::uint32_t k = 0; k <= around; ++k) {
      const float a = static_cast<float>(k) / around * 6.2831853F,
                  b = static_cast<float>(i) / up * 3.1415927F;
      const glm::vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      mesh.position.push_back(middle + radius * n);
      mesh.normal.push_back(n);
      mesh.uv[0].push_back({static_cast<float>(k) / 4, 3 - static_cast<float>(i) / 2});
    }
  }
  for (std::uint32_t i = 0; i < up; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * (around + 1) + k, b = a + around + 1;
      for (const std::uint32_t c : {a, a + 1, b, a + 1, b + 1, b}) mesh.index.wide.push_back(c);
    }
  }
  mesh.bounds = bounds_of(mesh.position.span());
  return mesh;
}

TEST(Compressed, RequiresWhatItIsWrittenIn) {
  const json document = json_of(written(model_of(square(job())), compressed));
  EXPECT_THAT(document["extensionsRequired"],
              UnorderedElementsAre("KHR_mesh_quantization", "EXT_meshopt_compression"));
  EXPECT_EQ(document["extensionsRequired"], document["extensionsUsed"]);
  ASSERT_EQ(document["buffers"].size(), 2U);
  EXPECT_EQ(document["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
  std::size_t end = 0;
  for (const json& view : document["bufferViews"]) {
    EXPECT_EQ(view["buffer"], 1);
    end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
  }
  EXPECT_LE(end, document["buffers"][1]["byteLength"].get<std::size_t>());
}

TEST(Compressed, RequiresNoExtensionWhereNothingIsStored) {
  const json document = json_of(written(Model{}, compressed));
  EXPECT_FALSE(document.contains("extensionsRequired"));
  EXPECT_FALSE(document.contains("buffers"));
}

TEST(Compressed, KeepsPositionsWithinHalfAStep) {
  const Mesh given = ball(job(), 3, {10, -5, 2});
  const Decoded read(written(model_of(ball(job(), 3, {10, -5, 2})), compressed));
  const auto step = read.document()["nodes"][0]["scale"][0].get<float>();
  EXPECT_EQ(step, std::exp2(-13.0F));  // 6 metres in 65,534 steps, a power of two
  const std::vector<glm::vec3> positions = read.positions(0, 0);
  ASSERT_GE(positions.size(), 200U);
  for (const glm::vec3& p : positions) {
    float nearest = 1e9F;
    for (const glm::vec3& q : given.position) nearest = std::min(nearest, glm::length(p - q));
    EXPECT_LE(nearest, 0.8661F * step + 1e-6F);
  }
}

TEST(Compressed, KeepsNormalsAndTextureCoordinates) {
  const Mesh given = ball(job(), 1, {0, 0, 0});
  const Decoded read(written(model_of(ball(job(), 1, {0, 0, 0})), compressed));
  const json& attributes = read.mesh(0)["attributes"];
  const std::vector<glm::vec3> positions = read.positions(0, 0);
  const auto normals = read.elements<glm::i16vec4>(attributes["NORMAL"]);
  const auto uvs = read.elements<glm::vec2>(attributes["TEXCOORD_0"]);
  EXPECT_EQ(read.accessor(attributes["NORMAL"])["componentType"], 5122);
  EXPECT_EQ(read.accessor(attributes["NORMAL"])["normalized"], true);
  ASSERT_EQ(positions.size(), normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::vec3 n = glm::vec3(normals[i]) / 32767.0F;
    EXPECT_NEAR(glm::length(n), 1, 1e-3);
    EXPECT_GT(glm::dot(n, positions[i]), 0.9999F);
    EXPECT_EQ(uvs[i] * 4.0F, glm::round(uvs[i] * 4.0F));  // quarters are exact
  }
}

TEST(Compressed, SharesPointsBetweenMeshesOfOneSize) {
  // Two tiles side by side: their common edge has the same numbers, moved by a whole number of steps.
  const Job fresh = job();
  Mesh right = square(fresh);
  for (glm::vec3& p : right.position) p.x += 1;
  right.bounds = bounds_of(right.position.span());
  const Decoded read(written(model_of(square(fresh), std::move(right)), compressed));
  const std::vector<glm::vec3> left_points = read.positions(0, 0), right_points = read.positions(1, 1);
  EXPECT_EQ(left_points[1], right_points[0]);
  EXPECT_EQ(left_points[2], right_points[3]);
}

TEST(Compressed, JoinsWhatBecameEqualAndDropsWhatBecameFlat) {
  const Job fresh = job();
  Mesh mesh = square(fresh, 100);
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1e-5F, 0), glm::vec2(0, 1e-5F)}) {
    mesh.position.push_back({50 + corner.x, 50 + corner.y, 0});
    mesh.normal.push_back({0, 0, 1});
    mesh.uv[0].push_back({0.5F, 0.5F});
    mesh.index.wide.push_back(first + static_cast<std::uint32_t>(mesh.index.wide.size()) % 3);
  }
  const Decoded read(written(model_of(std::move(mesh)), compressed));
  EXPECT_EQ(read.accessor(read.mesh(0)["indices"])["count"], 6);
  EXPECT_EQ(read.accessor(read.mesh(0)["attributes"]["POSITION"])["count"], 4);
}

TEST(Compressed, MovesTheGridOfASkinIntoItsMatrices) {
  const json plain = json_of(written(bending_band(job()), {}));
  const json document = json_of(written(bending_band(job()), compressed));
  EXPECT_FALSE(document["nodes"][0].contains("scale"));
  EXPECT_EQ(document["nodes"].size(), plain["nodes"].size());
}

TEST(Compressed, PutsAMeshBelowANodeThatBearsOthers) {
  Model model = model_of(square(job()), square(job()));
  model.nodes[1].parent = 0;
  const json document = json_of(written(std::move(model), compressed));
  ASSERT_EQ(document["nodes"].size(), 3U);
  EXPECT_FALSE(document["nodes"][0].contains("mesh"));
  EXPECT_EQ(document["nodes"][2]["name"], "shape0_mesh");
  EXPECT_THAT(document["nodes"][0]["children"], ElementsAre(1, 2));
}

TEST(Compressed, IsTheSameInAllContainers) {
  for (const Container container : {Container::gltf, Container::zip}) {
    const std::string text = written(textured(job()), compressed, container).text();
    EXPECT_NE(text.find("EXT_meshopt_compression"), std::string::npos);
  }
}

TEST(Compressed, ChoosesTheStepForTheLeastExtent) {
  Job fresh = job();
  WriteOptions options{Container::glb, "seedmesh test", compressed};
  options.least_extent = 1'000;
  const Decoded read(write(model_of(ball(fresh, 3, {0, 0, 0})), options, fresh));
  EXPECT_EQ(read.document()["nodes"][0]["scale"][0].get<double>(), std::exp2(-6));  // 1,000 m in 65,534 steps
}

TEST(Compressed, WritesTheGridOfANodeAsDoubles) {
  const json document = json_of(written(model_of(ball(job(), 3, {10, -5, 2})), compressed));
  const json& node = document["nodes"][0];
  const auto step = node["scale"][0].get<double>();
  EXPECT_EQ(step, std::exp2(-13));
  for (const json& number : node["translation"]) {
    const double steps = number.get<double>() / step;
    EXPECT_EQ(steps, std::round(steps));
  }
}

TEST(Quantized, NeedsNoDecoder) {
  const json document = json_of(written(model_of(ball(job(), 1, {0, 0, 0})), quantized));
  EXPECT_THAT(document["extensionsRequired"], ElementsAre("KHR_mesh_quantization"));
  EXPECT_EQ(document["buffers"].size(), 1U);
  const json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  const auto accessor = [&](const char* name) { return document["accessors"][attributes[name].get<int>()]; };
  EXPECT_EQ(accessor("POSITION")["componentType"], 5123);
  EXPECT_EQ(accessor("NORMAL")["componentType"], 5122);
  EXPECT_EQ(accessor("NORMAL")["normalized"], true);
  EXPECT_EQ(accessor("TEXCOORD_0")["componentType"], 5126);  // beyond 0..1
  // glTF 2.0, 3.7.2.1: elements of vertices start at multiples of four bytes.
  for (const char* name : {"POSITION", "NORMAL"})
    EXPECT_EQ(document["bufferViews"][accessor(name)["bufferView"].get<int>()]["byteStride"], 8) << name;
}

TEST(Quantized, LeavesCopiesWhereTheyStand) {
  Dialect dialect = quantized;
  dialect.gpu_instances = true;
  const Payload glb = written(scattered(job()), dialect);
  const json document = json_of(glb);
  const json& copies = document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const tinygltf::Model model = read_glb(glb);
  const std::vector<Transform> given = scattered(job()).nodes[0].instances.transforms;
  const auto translation = elements<glm::vec3>(model, copies["TRANSLATION"].get<int>());
  ASSERT_EQ(translation.size(), given.size());
  glm::vec3 low(1e9F), high(-1e9F);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(translation[i], given[i].translation);
    low = glm::min(low, given[i].translation);
    high = glm::max(high, given[i].translation);
  }
  const json& row = document["accessors"][copies["TRANSLATION"].get<int>()];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(row["min"][axis].get<float>(), low[static_cast<int>(axis)]);
    EXPECT_EQ(row["max"][axis].get<float>(), high[static_cast<int>(axis)]);
  }
  const json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(document["accessors"][attributes["POSITION"].get<int>()]["componentType"], 5126);
}

TEST(Instances, BecomeArraysWhereTheReaderTakesThem) {
  const Payload glb = written(scattered(job()), gpu);
  const json document = json_of(glb);
  ASSERT_EQ(document["nodes"].size(), 1U);
  const json& attributes = document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const tinygltf::Model model = read_glb(glb);
  const auto translation = elements<glm::vec3>(model, attributes["TRANSLATION"].get<int>());
  const auto rotation = elements<glm::vec4>(model, attributes["ROTATION"].get<int>());
  const auto scale = elements<glm::vec3>(model, attributes["SCALE"].get<int>());
  ASSERT_EQ(translation.size(), 5U);
  EXPECT_EQ(translation[3], glm::vec3(3, 6, 0.5F));
  EXPECT_EQ(rotation[2], glm::vec4(0, 0.6F, 0, 0.8F));
  EXPECT_EQ(scale[4], glm::vec3(5));
  EXPECT_THAT(document["extensionsRequired"], ElementsAre("EXT_mesh_gpu_instancing"));
}

TEST(Instances, StayNodesForASkinnedMesh) {
  Model model = bending_band(job());
  model.nodes[0].instances.transforms.resize(2);
  EXPECT_FALSE(json_of(written(std::move(model), gpu)).contains("extensionsRequired"));
}

TEST(Instances, AreReadByNodesAndArraysAlike) {
  Dialect both = compressed;
  both.gpu_instances = true;
  const Decoded read(written(scattered(job()), both));
  const json& attributes = read.document()["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const auto translation = read.elements<glm::vec3>(attributes["TRANSLATION"]);
  const auto scale = read.elements<glm::vec3>(attributes["SCALE"]);
  const auto rotation = read.elements<glm::i16vec4>(attributes["ROTATION"]);
  const auto positions = read.elements<glm::u16vec4>(read.mesh(0)["attributes"]["POSITION"]);
  const std::vector<Transform> given = scattered(job()).nodes[0].instances.transforms;
  const Mesh plain = square(job());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const glm::vec4 q = glm::vec4(rotation[i]) / 32767.0F;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const glm::vec3 is =
          translation[i] + glm::quat(q.w, q.x, q.y, q.z) * (scale[i] * glm::vec3(positions[v]));
      const glm::vec3 was = given[i].translation + given[i].rotation * (given[i].scale * plain.position[v]);
      EXPECT_LT(glm::length(is - was), 1e-3F);
    }
  }
}

TEST(Levels, AreNamedByTheNodeAndShownByNoScene) {
  const json document = json_of(written(with_lods(job()), lods));
  EXPECT_THAT(document["extensionsUsed"], ElementsAre("MSFT_lod"));
  EXPECT_FALSE(document.contains("extensionsRequired"));
  ASSERT_EQ(document["nodes"].size(), 4U);
  EXPECT_THAT(document["nodes"][0]["extensions"]["MSFT_lod"]["ids"], ElementsAre(2, 3));
  EXPECT_EQ(document["nodes"][0]["extras"]["MSFT_screencoverage"].size(), 3U);
  EXPECT_EQ(document["nodes"][2]["name"], "shape0_LOD1");
  EXPECT_EQ(document["nodes"][2]["mesh"], document["nodes"][0]["mesh"].get<int>() + 1);
  EXPECT_THAT(document["scenes"][0]["nodes"], ElementsAre(0, 1));
  EXPECT_FALSE(json_of(written(with_lods(job()), {})).contains("extensionsUsed"));
}

/// A root with two parts: the first has two coarser levels, the second is the same at all of them.
Model object_of(const Job& job) {
  Model model = with_lods(job);
  Node root;
  root.name = "thing";
  for (Node& node : model.nodes) node.parent = 0;
  model.nodes.insert(model.nodes.begin(), root);
  return model;
}

TEST(Levels, OfAnObjectAreOfItsRoot) {
  const json document = json_of(written(object_of(job()), lods));
  const json& nodes = document["nodes"];
  ASSERT_EQ(nodes.size(), 3U + 2 * 2 + 2);
  EXPECT_THAT(nodes[0]["extensions"]["MSFT_lod"]["ids"], ElementsAre(7, 8));
  EXPECT_EQ(nodes[0]["extras"]["MSFT_screencoverage"].size(), 3U);
  for (const std::size_t part : {1U, 2U}) EXPECT_FALSE(nodes[part].contains("extensions"));
  EXPECT_EQ(nodes[7]["name"], "thing_LOD1");
  EXPECT_THAT(nodes[7]["children"], ElementsAre(3, 4));
  EXPECT_THAT(nodes[8]["children"], ElementsAre(5, 6));
  EXPECT_EQ(nodes[3]["mesh"], nodes[1]["mesh"].get<int>() + 1);
  EXPECT_EQ(nodes[4]["mesh"], nodes[2]["mesh"]);
  EXPECT_EQ(nodes[5]["mesh"], nodes[1]["mesh"].get<int>() + 2);
  EXPECT_THAT(document["scenes"][0]["nodes"], ElementsAre(0));
}

TEST(Levels, OfPartsThatStandApartAreTheirOwn) {
  Model moved = object_of(job());
  moved.nodes[2].transform.translation = {5, 0, 0};
  Model other = object_of(job());
  other.nodes[2].lods = {other.nodes[1].lods.front()};
  for (Model* model : {&moved, &other}) {
    const json document = json_of(written(std::move(*model), lods));
    EXPECT_FALSE(document["nodes"][0].contains("extensions"));
    EXPECT_TRUE(document["nodes"][1]["extensions"].contains("MSFT_lod"));
  }
}

TEST(Levels, OfCopiesAreNodesOfTheirOwn) {
  Model model = with_lods(job());
  model.nodes[0].instances = scattered(job()).nodes[0].instances;
  const json document = json_of(written(std::move(model), lods));
  ASSERT_EQ(document["nodes"].size(), 2U + 5 + 5 * 2);
  for (std::size_t copy = 0; copy < 5; ++copy) {
    const json& node = document["nodes"][2 + copy];
    EXPECT_THAT(node["extensions"]["MSFT_lod"]["ids"], ElementsAre(7 + 2 * copy, 8 + 2 * copy));
    for (const json& id : node["extensions"]["MSFT_lod"]["ids"]) {
      EXPECT_EQ(document["nodes"][id.get<std::size_t>()].value("translation", json()),
                node.value("translation", json()));
    }
  }
}

TEST(Levels, KeepTheirInstances) {
  Model model = with_lods(job());
  model.nodes[0].instances = scattered(job()).nodes[0].instances;
  const json document = json_of(written(std::move(model), {true, true, true}));
  ASSERT_EQ(document["nodes"].size(), 4U);
  for (const std::size_t node : {2U, 3U}) {
    EXPECT_EQ(document["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"],
              document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]);
  }
  EXPECT_THAT(document["extensionsUsed"], IsSupersetOf({"MSFT_lod", "EXT_mesh_gpu_instancing"}));
}

}  // namespace
}  // namespace seedmesh
