/// A GLB that somebody gives: what is read from good ones, what is said of bad ones.
#include "core/gltf/read/read.h"

#include <gmock/gmock.h>

#include <cstring>

#include "core/gltf/write/write.h"

namespace seedmesh {
namespace {

using testing::HasSubstr;

/// GLB of a JSON text and a BIN chunk.
std::string glb_of(std::string json, std::string bin) {
  json.append((4 - json.size() % 4) % 4, ' ');
  bin.append((4 - bin.size() % 4) % 4, '\0');
  const auto word = [](std::size_t number) {
    std::string text(4, '\0');
    const auto value = static_cast<std::uint32_t>(number);
    std::memcpy(text.data(), &value, 4);
    return text;
  };
  const std::size_t size = 12 + 8 + json.size() + (bin.empty() ? 0 : 8 + bin.size());
  std::string glb = "glTF" + word(2) + word(size) + word(json.size()) + "JSON" + json;
  if (!bin.empty()) {
    glb += word(bin.size());
    glb += std::string("BIN\0", 4) + bin;
  }
  return glb;
}

std::string floats(std::initializer_list<float> numbers) {
  std::string bytes;
  for (const float number : numbers) bytes.append(reinterpret_cast<const char*>(&number), 4);
  return bytes;
}

const std::string triangle = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});

std::string json_of(const std::string& accessor, const std::string& more = "",
                    const std::string& primitive = R"({"attributes":{"POSITION":0}})") {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[)" +
         accessor + R"(],"meshes":[{"primitives":[)" + primitive +
         R"(]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)" + more + "}";
}

const std::string three_points =
    R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})";

Result<Model> read(const std::string& glb) {
  Job job(0, Job::Options{});
  return read_glb(std::as_bytes(std::span(glb)), "/element/glb", job);
}

std::string refusal(const std::string& glb) {
  const Result<Model> model = read(glb);
  if (model) return "";
  EXPECT_EQ(model.error().issues.front().pointer, "/element/glb");
  return model.error().issues.front().message;
}

TEST(ReadGlb, ReadsATriangleAndGivesItAFlatNormal) {
  const Result<Model> model = read(glb_of(json_of(three_points), triangle));
  ASSERT_TRUE(model) << model.error().issues.front().message;
  const Mesh& mesh = model->meshes.at(0).primitives.at(0).mesh;
  ASSERT_EQ(mesh.elements(), 1U);
  EXPECT_EQ(mesh.position[mesh.index.at(1)], glm::vec3(1, 0, 0));
  EXPECT_EQ(mesh.normal[0], glm::vec3(0, 0, 1));
  EXPECT_TRUE(model->warnings.empty());
}

TEST(ReadGlb, ReadsWhatTheWriterWrites) {
  Job job(0, Job::Options{});
  Model given;
  Material& red = given.materials.emplace_back();
  red.name = "red";
  red.roughness = 0.5F;
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const glm::vec3& p :
       {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)}) {
    mesh.position.push_back(p);
    mesh.normal.push_back({0, 0, 1});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(i);
  given.meshes.emplace_back().primitives.push_back({std::move(mesh), 0, {}});
  given.meshes[0].name = "square";
  Node& node = given.nodes.emplace_back();
  node.name = "square";
  node.mesh = 0;
  node.transform.translation = {0, 0, 5};
  node.transform.scale = {2, 2, 2};
  const std::string glb = write(std::move(given), Container::glb, "test", job).text();

  const Result<Model> model = read(glb);
  ASSERT_TRUE(model) << model.error().issues.front().message;
  const Primitive& primitive = model->meshes.at(0).primitives.at(0);
  EXPECT_EQ(primitive.mesh.elements(), 2U);
  EXPECT_EQ(primitive.mesh.position.size(), 4U);
  EXPECT_EQ(bounds_of(primitive.mesh.position.span()).max, glm::vec3(2, 2, 5));
  EXPECT_EQ(model->materials.at(static_cast<std::size_t>(primitive.material)).roughness, 0.5F);
}

TEST(ReadGlb, TurnsTrianglesOfAMirrorSoThatTheirNormalsAgree) {
  const std::string mirrored =
      json_of(three_points)
          .replace(json_of(three_points).find(R"({"mesh":0})"), 10, R"({"mesh":0,"scale":[-1,1,1]})");
  const Result<Model> model = read(glb_of(mirrored, triangle));
  ASSERT_TRUE(model) << model.error().issues.front().message;
  const Mesh& mesh = model->meshes[0].primitives[0].mesh;
  const glm::vec3 a = mesh.position[mesh.index.at(0)], b = mesh.position[mesh.index.at(1)],
                  c = mesh.position[mesh.index.at(2)];
  EXPECT_GT(glm::dot(glm::cross(b - a, c - a), mesh.normal[0]), 0);
}

TEST(ReadGlb, TakesBase64) {
  Job job(0, Job::Options{});
  const Result<Model> none = read_glb("data:model/gltf-binary;base64,Z2xURg==", "/glb", job);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().issues.front().message, HasSubstr("no GLB"));
  const Result<Model> odd = read_glb("data:model/gltf-binary;base64,Z2x!", "/glb", job);
  ASSERT_FALSE(odd);
  EXPECT_THAT(odd.error().issues.front().message, HasSubstr("character 4"));
  EXPECT_FALSE(read_glb("data:text/plain;base64,Z2xU", "/glb", job));
}

TEST(ReadGlb, ReportsTheErrorOfABadFile) {
  EXPECT_THAT(refusal("glTF"), HasSubstr("no GLB"));
  EXPECT_THAT(refusal(glb_of("{", "")), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal(glb_of(std::string(100, '['), "")), HasSubstr("deeper"));
  EXPECT_THAT(refusal(glb_of(json_of(three_points), triangle) + "x"), HasSubstr("header"));
  EXPECT_THAT(
      refusal(glb_of(json_of(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})"), triangle)),
      HasSubstr("inside its buffer"));
  EXPECT_THAT(
      refusal(glb_of(json_of(R"({"bufferView":7,"componentType":5126,"count":3,"type":"VEC3"})"), triangle)),
      HasSubstr("accessor"));
  EXPECT_THAT(refusal(glb_of(json_of(three_points, R"(,"extensionsRequired":["EXT_meshopt_compression"])"),
                             triangle)),
              HasSubstr("EXT_meshopt_compression"));
  EXPECT_THAT(refusal(glb_of(json_of(three_points), floats({0, 0, 0, 1e30F, 0, 0, 0, 1, 0}))),
              testing::AnyOf(HasSubstr("1,000,000"), HasSubstr("not finite")));
  EXPECT_THAT(
      refusal(glb_of(json_of(three_points, "", R"({"attributes":{"POSITION":0},"indices":0})"), triangle)),
      HasSubstr("indices"));
  EXPECT_THAT(refusal(glb_of(json_of(three_points), floats({0, 0, 0, 1, 0, 0, 2, 0, 0}))),
              HasSubstr("no triangles"));
}

TEST(ReadGlb, OpensNoFilesAndCopiesNoBufferTwice) {
  std::string json = json_of(three_points);
  const std::string outside = R"([{"byteLength":36,"uri":"/etc/hostname"}])";
  EXPECT_THAT(refusal(glb_of(json.replace(json.find(R"([{"byteLength":36}])"), 19, outside), triangle)),
              HasSubstr("one buffer"));
  json = json_of(three_points);
  const std::string two = R"([{"byteLength":36},{"byteLength":36}])";
  EXPECT_THAT(refusal(glb_of(json.replace(json.find(R"([{"byteLength":36}])"), 19, two), triangle)),
              HasSubstr("one buffer"));
}

TEST(ReadGlb, RefusesNodesInACircle) {
  std::string json = json_of(three_points);
  json.replace(json.find(R"({"mesh":0})"), 10, R"({"mesh":0,"children":[0]})");
  EXPECT_NE(refusal(glb_of(json, triangle)), "");
}

TEST(ReadGlb, ReportsSkippedContent) {
  const Result<Model> model = read(glb_of(json_of(three_points, R"(,"images":[{"uri":"a.png"}])"), triangle));
  ASSERT_TRUE(model) << model.error().issues.front().message;
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_THAT(model->warnings[0].message, HasSubstr("images"));
}

}  // namespace
}  // namespace seedmesh
