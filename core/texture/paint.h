#pragma once
/// Material::recipe -> textures of the model.
#include <span>
#include <string_view>

#include "core/base/texture_store.h"
#include "core/model/model.h"
#include "core/texture/bark.h"

namespace seedmesh::texture {

/// All kinds that a recipe may name: barks, leaves, twigs, petals, walls and roofs.
std::span<const std::string_view> texture_kinds();

/// Bark and walls: what goes on beyond its edges.
bool is_repeating_kind(std::string_view name);

/// `kind` is one of texture_kinds().
Painting paint_kind(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job);

/// Makes what the recipes ask for, `size` texels wide and high (a power of two from 16 to 4096), equal
/// recipes once, and lets their materials use it: base colour, normals, occlusion and roughness; leaves and
/// petals are cut out by alpha and seen from both sides. `store` may be null. Size 0 takes all textures off
/// the model instead, those that generators put there too; colours stay.
void paint(Model& model, int size, TextureStore* store, const Job& job);

}  // namespace seedmesh::texture
