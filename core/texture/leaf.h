#pragma once
/// Textures of leaves, twigs and petals by seed, with their outline in alpha. The image covers the box of the
/// drawing (LeafDrawing::low .. high, tip up), so that the cards and meshes of core/geom/plant/leaf_mesh.h
/// fit it.
#include <span>
#include <string_view>

#include "core/geom/plant/leaf_shape.h"
#include "core/model/model.h"
#include "core/texture/bark.h"

namespace seedmesh::texture {

/// The names of all kinds. "birch_leaf" shows one leaf, "birch_twig" a twig with several. Some shapes have no
/// twig.
std::span<const std::string_view> leaf_kinds();

/// The content of the image of a kind.
struct LeafPicture {
  LeafShape shape = LeafShape::simple;
  int count = 1;
};
/// Returns the content of a kind, which has to be one of leaf_kinds().
LeafPicture leaf_picture(std::string_view kind);

/// Returns the kind that shows a leaf of a shape, or a twig if there is one.
std::string_view leaf_kind(LeafShape shape, bool is_twig);

/// Returns the least alpha of texels that are drawn. For distant leaves, renderers compare it with the mean alpha of
/// many texels. Images of thin needles therefore need a low value; otherwise distant crowns vanish.
float leaf_cutoff(std::string_view kind);

/// Makes the material one of thin leaves. Light passes through, less through needles. Except through petals,
/// it is more yellow than the reflected light. Reflections are weaker than those of a plain dielectric,
/// because the cuticle is rough at grazing angles. The shares are in the range that the PROSPECT model gives
/// for fresh leaves (Jacquemoud and Baret, 1990).
void let_light_through(Material& material, LeafShape shape);

/// Returns the relief of a leaf or twig. `kind` is one of leaf_kinds(). Cost: 10 to 30 ns a texel.
Relief leaf_relief(std::string_view kind, int size, std::uint64_t seed, const Job& job);
/// Returns how the relief becomes images.
Finish leaf_finish(std::string_view kind, const Tint& tint);

}  // namespace seedmesh::texture
