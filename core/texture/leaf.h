#pragma once
/// Leaves, twigs and petals by seed, with their outline as alpha. The picture shows the box of the drawing
/// (LeafDrawing::low .. high, tip up), so that cards and meshes of core/geom/leaf_mesh.h fit it.
#include <span>
#include <string_view>

#include "core/geom/leaf_shape.h"
#include "core/texture/bark.h"

namespace seedmesh::texture {

/// "birch_leaf" shows one leaf, "birch_twig" a twig of several; for every LeafShape but some that make no
/// twig.
std::span<const std::string_view> leaf_kinds();

/// What a kind shows.
struct LeafPicture {
  LeafShape shape = LeafShape::simple;
  int count = 1;
};
LeafPicture leaf_picture(std::string_view kind);

/// The kind that shows one leaf of a shape, or a twig of it; the leaf where there is no twig.
std::string_view leaf_kind(LeafShape shape, bool is_twig);

/// The alpha from which a texel is drawn. Renderers compare it with means over many texels where the leaf is
/// far away, so that a picture of thin needles, most of it empty, needs a low one or the crown vanishes.
float leaf_cutoff(std::string_view kind);

/// `kind` is one of leaf_kinds(). 10 to 30 ns a texel.
Painting paint_leaf(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job);

}  // namespace seedmesh::texture
