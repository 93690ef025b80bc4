/// Impostors: their content, its position, and equal bytes everywhere.
#include "core/texture/impostor.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/texture/png.h"

namespace seedmesh::texture {
namespace {

using testing::ElementsAre;

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

/// Rectangles that look along +Z, each from its lower left to its upper right corner.
Mesh sheets(const std::vector<std::array<glm::vec2, 2>>& boxes, float depth, Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const auto& [low, high] : boxes) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const glm::vec2 p : {low, {high.x, low.y}, high, {low.x, high.y}}) {
      mesh.position.push_back({p.x, p.y, depth + 0.01F * p.x});  // not quite level, so that it has a depth
      mesh.normal.push_back({0, 0, 1});
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(first + corner);
  }
  return mesh;
}

Node node_of(const char* name, int parent, int mesh) {
  Node node;
  node.name = name;
  node.parent = parent;
  node.mesh = mesh;
  return node;
}

/// A red sheet, and behind its left half a green one that reaches further up.
Model two_sheets(Job& job) {
  Model model;
  model.nodes.push_back(node_of("plant", -1, -1));
  for (const glm::vec4& color : {glm::vec4(1, 0, 0, 1), glm::vec4(0, 1, 0, 1)}) {
    const auto number = static_cast<int>(model.meshes.size());
    Material material;
    material.base_color = color;
    model.materials.push_back(std::move(material));
    model.meshes.push_back({"sheet", {}});
    Mesh mesh = number == 0 ? sheets({{glm::vec2(-1, 0), glm::vec2(1, 1)}}, 0.5F, job)
                            : sheets({{glm::vec2(-1, 0), glm::vec2(0, 2)}}, -0.5F, job);
    model.meshes.back().primitives.push_back({std::move(mesh), number, {}});
    model.nodes.push_back(node_of("sheet", 0, number));
  }
  return model;
}

Picture drawn(Model& model, int size, int threads = 1) {
  Job job = job_of(threads);
  draw_impostors(model, size, job);
  const Image& image = *model.textures.back();
  Result<Picture> picture = decode_png(std::as_bytes(std::span(image.bytes)), {}, job);
  EXPECT_TRUE(picture);
  return *std::move(picture);
}

std::array<int, 4> texel(const Picture& picture, std::size_t x, std::size_t y) {
  std::array<int, 4> channels{};
  for (std::size_t c = 0; c < 4; ++c) channels[c] = picture.bytes[(y * picture.width + x) * 4 + c];
  return channels;
}

TEST(Impostor, ShowsTheNearestSurfaceOrNothing) {
  Job job = job_of();
  Model model = two_sheets(job);
  ASSERT_EQ(add_impostor_levels(model, job), 1U);
  const Picture picture = drawn(model, 128);
  ASSERT_EQ(picture.width, 128U);
  ASSERT_EQ(picture.channels, 4);
  // The first view looks along -Z and is in the upper left quarter: 64 texels, with 2 free texels on each side.
  const auto below = texel(picture, 20, 50), above = texel(picture, 20, 15), open = texel(picture, 48, 15);
  EXPECT_GT(below[0], 150);
  EXPECT_EQ(below[1], 0);
  EXPECT_EQ(below[3], 255);
  EXPECT_GT(above[1], 150);
  EXPECT_EQ(above[3], 255);
  EXPECT_EQ(open[3], 0);
  EXPECT_EQ(texel(picture, 0, 0)[3], 0);
  EXPECT_GT(open[0] + open[1], 0) << "colours go on beyond the edge";
}

TEST(Impostor, ReplacesTheCoarsestLevelOfTheModel) {
  Job job = job_of();
  Model model = two_sheets(job);
  model.nodes[1].lods = {1};  // one mesh has two levels, the other one
  ASSERT_EQ(add_impostor_levels(model, job), 1U);
  EXPECT_THAT(model.nodes[1].lods, ElementsAre(1, 2));
  EXPECT_THAT(model.nodes[2].lods, ElementsAre(1, -1));
  EXPECT_TRUE(model.nodes[2].has_impostor);
  EXPECT_EQ(model.meshes[2].primitives.at(0).mesh.elements(), triangles_of_impostor);
}

TEST(Impostor, HasThePositionAndSizeOfTheModel) {
  Job job = job_of();
  Model model = two_sheets(job);
  add_impostor_levels(model, job);
  const Mesh& quads = model.meshes[2].primitives.at(0).mesh;
  const Box box = bounds_of(quads.position.span());
  EXPECT_FLOAT_EQ(box.min.y, 0);
  EXPECT_FLOAT_EQ(box.max.y, 2);
  EXPECT_FLOAT_EQ(box.min.x, -1);
  EXPECT_FLOAT_EQ(box.max.x, 1);
  for (const glm::vec3& normal : quads.normal) EXPECT_NEAR(glm::dot(normal, normal), 1, 1e-6);
}

TEST(Impostor, CoversAsManyTexelsAsTheModel) {
  Job job = job_of();
  std::vector<std::array<glm::vec2, 2>> boxes;
  Rng rng(5);
  for (int i = 0; i < 900; ++i) {  // each half a texel wide, most apart from each other
    const auto x = static_cast<float>(i % 30), y = static_cast<float>(i / 30);
    // One after the other: compilers draw the arguments of a call in an order of their own.
    const float south = y + static_cast<float>(rng.unit()) * 0.4F;
    const glm::vec2 low(x + static_cast<float>(rng.unit()) * 0.8F, south);
    boxes.push_back({low, low + glm::vec2(0.2F, 0.6F)});
  }
  Model model;
  model.nodes.push_back(node_of("plant", -1, -1));
  model.meshes.push_back({"leaves", {}});
  model.meshes.back().primitives.push_back({sheets(boxes, 0, job), -1, {}});
  model.nodes.push_back(node_of("leaves", 0, 0));
  ASSERT_EQ(add_impostor_levels(model, job), 1U);
  const Picture picture = drawn(model, 128);
  std::size_t there = 0;
  for (std::size_t y = 2; y < 62; ++y) {
    for (std::size_t x = 2; x < 62; ++x) there += texel(picture, x, y)[3] >= 128 ? 1 : 0;
  }
  const double share = static_cast<double>(there) / (60.0 * 60.0), covered = 900 * 0.12 / (30.0 * 30.0);
  EXPECT_NEAR(share, covered, 0.05);
}

TEST(Impostor, HasTheNormalsOfWhatItShows) {
  Job job = job_of();
  Model model;
  model.nodes.push_back(node_of("plant", -1, -1));
  model.meshes.push_back({"roof", {}});
  Mesh mesh = sheets({{glm::vec2(-1, 0), glm::vec2(0, 1)}, {glm::vec2(0, 0), glm::vec2(1, 1)}}, 0, job);
  for (std::size_t i = 0; i < 4; ++i) mesh.normal[i] = {0, 0.6F, 0.8F};
  for (std::size_t i = 4; i < 8; ++i) mesh.normal[i] = {0.6F, 0, -0.8F};  // its back is seen
  model.meshes.back().primitives.push_back({std::move(mesh), -1, {}});
  model.nodes.push_back(node_of("roof", 0, 0));
  ASSERT_EQ(add_impostor_levels(model, job), 1U);
  drawn(model, 128);
  const Material& material = model.materials.back();
  ASSERT_GE(material.normal_texture.texture, 0);
  const Image& image = *model.textures[static_cast<std::size_t>(material.normal_texture.texture)];
  const Result<Picture> picture = decode_png(std::as_bytes(std::span(image.bytes)), {}, job);
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->width, 64U);
  ASSERT_EQ(picture->channels, 3);
  const auto normal = [&](std::size_t x, std::size_t y) {
    std::array<int, 3> channels{};
    for (std::size_t c = 0; c < 3; ++c) channels[c] = picture->bytes[(y * 64 + x) * 3 + c];
    return channels;
  };
  const auto is_near = [](const std::array<int, 3>& found, const std::array<int, 3>& expected) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2);
  };
  // The first view looks along -Z and is in the upper left quarter: 32 texels.
  is_near(normal(8, 16), {128, 204, 230});
  is_near(normal(24, 16), {51, 128, 230});
  is_near(normal(48, 48), {128, 128, 255});  // the quarter that stays free
}

TEST(Impostor, ShowsOneSideOfEachQuad) {
  Job job = job_of();
  Model model = two_sheets(job);
  add_impostor_levels(model, job);
  EXPECT_FALSE(model.materials.back().double_sided);
  const Mesh& quads = model.meshes[2].primitives.at(0).mesh;
  for (std::size_t i = 0; i < quads.index.size(); i += 3) {
    const auto corner = [&](std::size_t c) { return quads.position[quads.index.at(i + c)]; };
    const glm::vec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(glm::dot(across, quads.normal[quads.index.at(i + c)]), 0);
  }
}

TEST(Impostor, IsTheSameWithAnyNumberOfThreads) {
  Job job = job_of();
  Model one = two_sheets(job), many = two_sheets(job);
  add_impostor_levels(one, job);
  add_impostor_levels(many, job);
  drawn(one, 256, 1);
  drawn(many, 256, 8);
  ASSERT_EQ(one.textures.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(one.textures[i]->bytes, many.textures[i]->bytes);
}

TEST(Impostor, IsNotMadeOfWhatHasNoTriangles) {
  Job job = job_of();
  Model model;
  model.nodes.push_back(node_of("lines", -1, -1));
  EXPECT_EQ(add_impostor_levels(model, job), 0U);
  EXPECT_EQ(add_impostor(model, {}, "nothing", job), -1);
}

}  // namespace
}  // namespace seedmesh::texture
