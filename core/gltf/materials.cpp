#include "core/gltf/materials.h"

#include <array>
#include <span>
#include <string_view>

#include "core/gltf/json_text.h"

namespace seedmesh::gltf {
namespace {

/// An object whose members are appended one by one; closed at the end.
class Members {
 public:
  explicit Members(std::string& out) : out_(out) {}

  /// Begins a member; its value is appended next.
  void begin(std::string_view name) {
    out_ += is_empty_ ? "{\"" : ",\"";
    out_ += name;
    out_ += "\":";
    is_empty_ = false;
  }
  /// Unless each of them is `usual`.
  void factors(std::string_view name, std::span<const float> values, float usual) {
    bool is_usual = true;
    for (const float value : values) is_usual = is_usual && value == usual;
    if (is_usual) return;
    begin(name);
    out_ += '[';
    for (const float& value : values) {
      if (&value != values.data()) out_ += ',';
      append_decimal(out_, value);
    }
    out_ += ']';
  }
  void factor(std::string_view name, float value, float usual) {
    if (value == usual) return;
    begin(name);
    append_decimal(out_, value);
  }
  /// Of the texture object `number`; nothing for -1.
  void texture(std::string_view name, int number, int uv_set) {
    if (number < 0) return;
    begin(name);
    out_ += "{\"index\":";
    append_integer(out_, number);
    if (uv_set != 0) {
      out_ += ",\"texCoord\":";
      append_integer(out_, uv_set);
    }
    out_ += '}';
  }
  bool is_empty() const { return is_empty_; }
  void end() { out_ += is_empty_ ? "{}" : "}"; }

 private:
  std::string& out_;
  bool is_empty_ = true;
};

}  // namespace

void append_material(std::string& out, const Material& material, const TextureNumber& texture_number) {
  // Numbered in this order.
  const int base = texture_number(material.base_color_texture),
            surface = texture_number(material.metallic_roughness_texture),
            normal = texture_number(material.normal_texture),
            occlusion = texture_number(material.occlusion_texture),
            emissive = texture_number(material.emissive_texture);
  Members members(out);
  if (material.alpha_mode == AlphaMode::mask) members.factor("alphaCutoff", material.alpha_cutoff, 0.5F);
  if (material.alpha_mode != AlphaMode::opaque) {
    members.begin("alphaMode");
    out += material.alpha_mode == AlphaMode::mask ? "\"MASK\"" : "\"BLEND\"";
  }
  if (material.double_sided) {
    members.begin("doubleSided");
    out += "true";
  }
  const glm::vec3& glow = material.emissive;
  members.factors("emissiveFactor", std::array{glow.x, glow.y, glow.z}, 0);
  members.texture("emissiveTexture", emissive, material.emissive_texture.uv_set);
  if (material.unlit) {
    members.begin("extensions");
    out += "{\"KHR_materials_unlit\":{}}";
  }
  if (!material.name.empty()) {
    members.begin("name");
    append_string(out, material.name);
  }
  members.texture("normalTexture", normal, material.normal_texture.uv_set);
  members.texture("occlusionTexture", occlusion, material.occlusion_texture.uv_set);
  const glm::vec4& color = material.base_color;
  std::string inner;
  Members pbr(inner);
  pbr.factors("baseColorFactor", std::array{color.x, color.y, color.z, color.w}, 1);
  pbr.texture("baseColorTexture", base, material.base_color_texture.uv_set);
  pbr.factor("metallicFactor", material.metallic, 1);
  pbr.texture("metallicRoughnessTexture", surface, material.metallic_roughness_texture.uv_set);
  pbr.factor("roughnessFactor", material.roughness, 1);
  if (!pbr.is_empty()) {
    pbr.end();
    members.begin("pbrMetallicRoughness");
    out += inner;
  }
  members.end();
}

}  // namespace seedmesh::gltf
