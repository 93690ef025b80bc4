#include "core/gltf/write/materials.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "core/gltf/json_writer.h"

namespace seedmesh::gltf {
namespace {

/// Adds the members of an object that differ from glTF's defaults.
class Members {
 public:
  explicit Members(std::string& out) : json(out) {}

  /// Nothing where all values are `usual`.
  void factors(std::string_view name, std::span<const float> values, float usual) {
    if (std::ranges::all_of(values, [usual](float value) { return value == usual; })) return;
    json.array(name, [&] {
      for (const float value : values) decimal(value);
    });
  }
  void factor(std::string_view name, float value, float usual) {
    if (value == usual) return;
    json.key(name);
    decimal(value);
  }
  /// Nothing for the texture -1.
  void texture(std::string_view name, int number, int uv_set) {
    if (number < 0) return;
    json.object(name, [&] {
      json.member("index", number);
      if (uv_set != 0) json.member("texCoord", uv_set);
    });
  }

  JsonWriter json;

 private:
  void decimal(float value) {
    std::string text;
    append_decimal(text, value);
    json.json(text);
  }
};

/// The members of pbrMetallicRoughness; empty where all have their defaults.
std::string surface_members(const Material& material, int base, int surface) {
  std::string text;
  Members members(text);
  const glm::vec4& color = material.base_color;
  members.factors("baseColorFactor", std::array{color.x, color.y, color.z, color.w}, 1);
  members.texture("baseColorTexture", base, material.base_color_texture.uv_set);
  members.factor("metallicFactor", material.metallic, 1);
  members.texture("metallicRoughnessTexture", surface, material.metallic_roughness_texture.uv_set);
  members.factor("roughnessFactor", material.roughness, 1);
  return text;
}

/// The members of `extensions`; empty where the material has none. `base`: its colour texture, or -1.
std::string extension_members(const Material& material, int base) {
  std::string text;
  Members members(text);
  if (material.transmission > 0) {
    members.json.object("KHR_materials_diffuse_transmission", [&] {
      const glm::vec3 color = glm::vec3(material.base_color) * material.transmission_color;
      members.factors("diffuseTransmissionColorFactor", std::array{color.x, color.y, color.z}, 1);
      members.texture("diffuseTransmissionColorTexture", base, material.base_color_texture.uv_set);
      members.factor("diffuseTransmissionFactor", material.transmission, 0);
    });
  }
  if (const float strength = emissive_strength(material); strength != 1) {
    members.json.object("KHR_materials_emissive_strength",
                        [&] { members.factor("emissiveStrength", strength, 1); });
  }
  if (material.has_specular()) {
    members.json.object("KHR_materials_specular", [&] {
      const glm::vec3& color = material.specular_color;
      members.factors("specularColorFactor", std::array{color.x, color.y, color.z}, 1);
      members.factor("specularFactor", material.specular, 1);
    });
  }
  if (material.unlit) members.json.object("KHR_materials_unlit", [] {});
  return text;
}

}  // namespace

float emissive_strength(const Material& material) {
  const glm::vec3& glow = material.emissive;
  return std::max({glow.x, glow.y, glow.z, 1.0F});
}

void append_material(std::string& out, const Material& material, const TextureNumber& texture_number) {
  // The textures get their numbers in this order.
  const int base = texture_number(material.base_color_texture),
            surface = texture_number(material.metallic_roughness_texture),
            normal = texture_number(material.normal_texture),
            occlusion = texture_number(material.occlusion_texture),
            emissive = texture_number(material.emissive_texture);
  Members members(out);
  JsonWriter& json = members.json;
  json.object([&] {
    if (material.alpha_mode == AlphaMode::mask) members.factor("alphaCutoff", material.alpha_cutoff, 0.5F);
    if (material.alpha_mode != AlphaMode::opaque)
      json.member("alphaMode", material.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND");
    if (material.double_sided) json.member("doubleSided", true);
    const glm::vec3 glow = material.emissive / emissive_strength(material);
    members.factors("emissiveFactor", std::array{glow.x, glow.y, glow.z}, 0);
    members.texture("emissiveTexture", emissive, material.emissive_texture.uv_set);
    if (const std::string inner = extension_members(material, base); !inner.empty()) {
      json.key("extensions");
      json.json('{' + inner + '}');
    }
    if (!material.name.empty()) json.member("name", material.name);
    members.texture("normalTexture", normal, material.normal_texture.uv_set);
    members.texture("occlusionTexture", occlusion, material.occlusion_texture.uv_set);
    if (const std::string inner = surface_members(material, base, surface); !inner.empty()) {
      json.key("pbrMetallicRoughness");
      json.json('{' + inner + '}');
    }
  });
}

}  // namespace seedmesh::gltf
