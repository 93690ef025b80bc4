#include "core/render/surfaces.h"

#include <map>
#include <memory>
#include <span>
#include <utility>

#include "core/texture/decode.h"

namespace seedmesh::render {
namespace {

constexpr float least_metallic = 0.5F;

std::unique_ptr<const texture::Texels> texels_of(const Image& image, float cutoff, const Job& job) {
  Result<texture::Decoded> decoded = texture::decode_picture(std::as_bytes(std::span(image.bytes)), {}, job);
  if (!decoded || !decoded->picture) return nullptr;
  return std::make_unique<const texture::Texels>(*decoded->picture, cutoff, job);
}

}  // namespace

Surfaces::Surfaces(const Model& model, const Job& job) {
  std::map<std::pair<int, float>, const texture::Texels*> known;
  for (const Material& material : model.materials) {
    Surface surface;
    surface.color = glm::vec3(material.base_color);
    surface.alpha = material.base_color.w;
    surface.both_sides = material.double_sided;
    surface.blends = material.alpha_mode == AlphaMode::blend;
    surface.unlit = material.unlit;
    surface.roughness = material.roughness;
    surface.metallic = material.metallic >= least_metallic && material.metallic_roughness_texture.texture < 0
                           ? material.metallic
                           : 0;
    surface.transmission = material.transmission;
    surface.emissive = material.emissive;
    const TextureUse& use = material.base_color_texture;
    if (use.texture >= 0) {
      const float cutoff = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0;
      const auto [place, is_new] = known.try_emplace({use.texture, cutoff}, nullptr);
      if (is_new) {
        const Image& image = *model.textures[static_cast<std::size_t>(use.texture)];
        if (std::unique_ptr<const texture::Texels> made = texels_of(image, cutoff, job)) {
          place->second = made.get();
          texels_.push_back(std::move(made));
        }
      }
      surface.texels = place->second;
      surface.uv_set = use.uv_set;
      surface.repeat = use.repeat;
    }
    list_.push_back(surface);
  }
  list_.emplace_back();
}

}  // namespace seedmesh::render
