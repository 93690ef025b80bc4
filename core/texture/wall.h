#pragma once
/// Surfaces of buildings by seed: brick, plaster, roof tiles, slate, planks, dressed stone, concrete, sheet
/// metal. Each repeats in both directions without a seam, has a size in metres, and up the wall or the slope
/// is up the picture.
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "core/texture/bark.h"

namespace seedmesh::texture {

struct WallKind {
  std::string_view name;
  glm::dvec2 tile;  ///< metres across and up that the picture shows
  /// Painted in shades of a light grey, which TextureRecipe::factor colours: joints take the colour too. The
  /// others are painted in TextureRecipe::color, and their mortar has a colour of its own.
  bool is_grey;
};

std::span<const WallKind> wall_kinds();

/// Null for a name that is none.
const WallKind* wall_kind(std::string_view name);

/// The grey that takes a colour: linear.
glm::vec3 wall_grey();

/// `name` is that of one of wall_kinds(). About 30 ns a texel.
Painting paint_wall(std::string_view name, int size, std::uint64_t seed, const Tint& tint, const Job& job);

}  // namespace seedmesh::texture
