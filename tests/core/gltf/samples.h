#pragma once
/// Small models, one for each thing that glTF can say, and ways to read back what was written of them.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/gltf/write/write.h"

namespace seedmesh::samples {

inline Job job(Limits limits = {}) { return Job(1, {.limits = limits}); }

/// A square of two triangles in the XY plane, facing +Z.
inline Mesh square(const Job& job, float size = 1) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, 4, {0, 0, 1});
  mesh.uv[0] = Array<glm::vec2>(job);
  for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    mesh.position.push_back({corner * size, 0});
    mesh.uv[0].push_back(corner);
  }
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(i);
  mesh.bounds = bounds_of(mesh.position.span());
  return mesh;
}

inline Material paint(std::string name, glm::vec4 color = {0.5F, 0.25F, 0.1F, 1}) {
  Material material;
  material.name = std::move(name);
  material.base_color = color;
  return material;
}

inline Node node(std::string name, int mesh = -1, int parent = -1) {
  Node made;
  made.name = std::move(name);
  made.mesh = mesh;
  made.parent = parent;
  return made;
}

/// Takes any number of meshes, each the only primitive of a group of its own, with material 0.
template <class... Meshes>
Model model_of(Meshes... meshes) {
  Model model;
  model.materials.push_back(paint("paint"));
  const auto add = [&](Mesh mesh) {
    const std::string name = "shape" + std::to_string(model.meshes.size());
    MeshGroup& group = model.meshes.emplace_back();
    group.name = name + "_mesh";
    group.primitives.push_back({std::move(mesh), 0, {}});
    model.nodes.push_back(node(name, static_cast<int>(model.meshes.size()) - 1));
  };
  (add(std::move(meshes)), ...);
  return model;
}

/// A PNG of one brown pixel.
inline std::shared_ptr<const Image> pixel(std::string name) {
  static constexpr std::uint8_t bytes[] = {
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00, 0x0C, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xDA, 0x63, 0x68, 0x48, 0x70, 0x00, 0x00, 0x02, 0x84, 0x01, 0x21, 0x57, 0x36, 0x6E,
      0x4E, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  auto image = std::make_shared<Image>();
  image->name = std::move(name);
  image->bytes.assign(std::begin(bytes), std::end(bytes));
  return image;
}

/// A band of two squares, one above the other, that bends at two joints: skin and a swaying animation.
inline Model bending_band(const Job& job) {
  Model model = model_of(square(job));
  Mesh& mesh = model.meshes[0].primitives[0].mesh;
  mesh.joints = Array<glm::u16vec4>(job, 4, {0, 0, 0, 0});
  mesh.weights = Array<glm::vec4>(job, 4, {1, 0, 0, 0});
  mesh.joints[2] = mesh.joints[3] = {1, 0, 0, 0};
  model.nodes[0].skin = 0;
  model.nodes.push_back(node("root"));
  model.nodes.push_back(node("tip", -1, 1));
  model.nodes[2].transform.translation = {0, 0.5F, 0};
  glm::mat4 tip_inverse(1);
  tip_inverse[3] = {0, -0.5F, 0, 1};
  model.skins.push_back({"bones", {1, 2}, {glm::mat4(1), tip_inverse}, 1});
  Animation& sway = model.animations.emplace_back();
  sway.name = "sway";
  sway.times = {{0, 0.5F, 1}};
  const float s = 0.70710678F;
  sway.channels.push_back(
      {2, Path::rotation, Interpolation::linear, 0, {0, 0, 0, 1, 0, 0, s, s, 0, 0, 0, 1}});
  sway.channels.push_back({2, Path::scale, Interpolation::step, 0, {1, 1, 1, 2, 2, 2, 1, 1, 1}});
  return model;
}

/// Every texture slot, images shared between slots and wrapped in two ways.
inline Model textured(const Job& job) {
  Model model = model_of(square(job));
  model.textures = {pixel("bark"), pixel("unused"), pixel("leaf")};
  Material& material = model.materials[0];
  material.base_color_texture = {0, 0, true};
  material.occlusion_texture = {0, 0, true};
  material.emissive_texture = {0, 0, false};
  material.metallic_roughness_texture = {2, 0, true};
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.3F;
  material.double_sided = true;
  return model;
}

/// A square that is green in summer and red in autumn; the last material is unused.
inline Model seasonal(const Job& job) {
  Model model = model_of(square(job));
  model.materials = {paint("green"), paint("red"), paint("unused")};
  model.variants = {"summer", "autumn", "late_autumn"};
  model.meshes[0].primitives[0].variant_materials = {0, 1, 1};
  return model;
}

/// A tree whose crown has two coarser levels and whose trunk has none.
inline Model with_lods(const Job& job) {
  Model model = model_of(square(job, 1), square(job, 2), square(job, 3), square(job, 4));
  model.name = "oak tree";
  model.nodes.resize(2);
  model.nodes[0].lods = {2, 3};
  return model;
}

/// Squares scattered about, turned and scaled.
inline Model scattered(const Job& job) {
  Model model = model_of(square(job));
  for (int i = 0; i < 5; ++i) {
    const auto at = static_cast<float>(i);
    model.nodes[0].instances.transforms.push_back(
        {{at, 2 * at, 0.5F}, glm::quat(0.8F, 0, 0.6F, 0), glm::vec3(1 + at)});
  }
  return model;
}

/// What the words of every dialect are needed for.
inline std::map<std::string, Model> dialect_samples(const Job& job) {
  std::map<std::string, Model> models;
  models["squares"] = model_of(square(job), square(job, 0.1F));
  models["bending_band"] = bending_band(job);
  models["textured"] = textured(job);
  models["seasonal"] = seasonal(job);
  models["lods"] = with_lods(job);
  models["instances"] = scattered(job);
  models["instances_with_lods"] = with_lods(job);
  models["instances_with_lods"].nodes[0].instances = scattered(job).nodes[0].instances;
  return models;
}

/// The JSON of a GLB.
inline nlohmann::json json_of(const Payload& glb) {
  const std::string bytes = glb.text();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return nlohmann::json::parse(bytes.substr(20, size));
}

/// What tinygltf reads from a GLB; a message of the reader fails the test.
inline tinygltf::Model read_glb(const Payload& glb) {
  const std::string bytes = glb.text();
  tinygltf::Model model;
  std::string fault, warning;
  const bool read = tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &fault, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size()), "");
  EXPECT_TRUE(read);
  EXPECT_EQ(fault, "");
  EXPECT_EQ(warning, "");
  return model;
}

inline tinygltf::Model read_gltf(const std::string& text, const std::string& folder = "") {
  tinygltf::Model model;
  std::string fault, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadASCIIFromString(&model, &fault, &warning, text.data(),
                                                       static_cast<unsigned>(text.size()), folder));
  EXPECT_EQ(fault, "");
  EXPECT_EQ(warning, "");
  return model;
}

/// The elements of an accessor as T, which has to be the type that is stored.
template <class T>
std::vector<T> elements(const tinygltf::Model& model, int accessor) {
  const auto& description = model.accessors.at(static_cast<std::size_t>(accessor));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(description.bufferView));
  const auto stride = static_cast<std::size_t>(description.ByteStride(view));
  EXPECT_EQ(stride, sizeof(T));
  EXPECT_LE(description.byteOffset + description.count * stride, view.byteLength);
  std::vector<T> values(description.count);
  std::memcpy(values.data(), model.buffers.at(0).data.data() + view.byteOffset + description.byteOffset,
              values.size() * sizeof(T));
  return values;
}

inline int attribute(const tinygltf::Primitive& primitive, const std::string& semantic) {
  const auto found = primitive.attributes.find(semantic);
  return found == primitive.attributes.end() ? -1 : found->second;
}

}  // namespace seedmesh::samples
