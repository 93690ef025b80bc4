#pragma once
/// Material::recipe -> textures of the model.
#include <span>
#include <string_view>

#include "core/base/texture_store.h"
#include "core/model/model.h"

namespace seedmesh::texture {

/// All kinds that a recipe may name: barks, leaves, twigs, petals.
std::span<const std::string_view> texture_kinds();

bool is_texture_kind(std::string_view name);
bool is_bark_kind(std::string_view name);

/// Makes what the recipes ask for, `size` texels wide and high (a power of two from 16 to 4096), equal
/// recipes once, and lets their materials use it: base colour, normals, occlusion and roughness; leaves and
/// petals are cut out by alpha and seen from both sides. `store` may be null. Size 0 takes all textures off
/// the model instead, those that generators put there too; colours stay.
void paint(Model& model, int size, TextureStore* store, const Job& job);

}  // namespace seedmesh::texture
