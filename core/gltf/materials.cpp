#include "core/gltf/materials.h"

#include <tiny_gltf.h>

#include "core/gltf/json_text.h"

namespace seedmesh::gltf {
namespace {

template <class Info>
void set_texture(Info& info, const TextureUse& use, const TextureNumber& texture_number) {
  info.index = texture_number(use);
  info.texCoord = use.uv_set;
}

void set_alpha(tinygltf::Material& out, const Material& material) {
  switch (material.alpha_mode) {
    case AlphaMode::opaque:
      out.alphaMode = "OPAQUE";
      break;
    case AlphaMode::blend:
      out.alphaMode = "BLEND";
      break;
    case AlphaMode::mask:
      out.alphaMode = "MASK";
      out.alphaCutoff = shortest(material.alpha_cutoff);
      break;
  }
}

}  // namespace

tinygltf::Material material_of(const Material& material, const TextureNumber& texture_number) {
  tinygltf::Material out;
  out.name = material.name;
  out.doubleSided = material.double_sided;
  set_alpha(out, material);

  tinygltf::PbrMetallicRoughness& surface = out.pbrMetallicRoughness;
  const glm::vec4& base = material.base_color;
  surface.baseColorFactor = {shortest(base.x), shortest(base.y), shortest(base.z), shortest(base.w)};
  surface.metallicFactor = shortest(material.metallic);
  surface.roughnessFactor = shortest(material.roughness);
  const glm::vec3& emissive = material.emissive;
  out.emissiveFactor = {shortest(emissive.x), shortest(emissive.y), shortest(emissive.z)};

  set_texture(surface.baseColorTexture, material.base_color_texture, texture_number);
  set_texture(surface.metallicRoughnessTexture, material.metallic_roughness_texture, texture_number);
  set_texture(out.normalTexture, material.normal_texture, texture_number);
  set_texture(out.occlusionTexture, material.occlusion_texture, texture_number);
  set_texture(out.emissiveTexture, material.emissive_texture, texture_number);

  if (material.unlit) out.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  return out;
}

}  // namespace seedmesh::gltf
