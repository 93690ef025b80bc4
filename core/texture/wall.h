#pragma once
/// Textures of surfaces by seed. For buildings: brick, plaster, roof tiles, slate, planks, ashlar, concrete,
/// sheet metal, metal panels, dressed stone and paint. Also: windows in walls (bay.h), rooms (rooms.h), doors
/// (joinery.h), dirt (grime.h) and grounds (ground.h). They tile seamlessly in both directions and have a
/// size in metres. The upper edge of an image points up the wall or the slope.
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "core/texture/bark.h"

namespace seedmesh::texture {

struct WallKind {
  std::string_view name;
  glm::dvec2 tile;  ///< the size of the image in metres
  /// Whether the texture is light grey. TextureRecipe::factor then colours all of it, joints included. Otherwise the
  /// image has the colour TextureRecipe::color, and mortar has a colour of its own.
  bool is_grey;
};

/// Returns all kinds of walls.
std::span<const WallKind> wall_kinds();

/// Returns the kind of this name; null if there is none.
const WallKind* wall_kind(std::string_view name);

/// Returns the mean grey of the textures with WallKind::is_grey, linear.
glm::vec3 wall_grey();

/// Returns the main grey of one kind that is grey, linear.
float grey_of(std::string_view name);

/// Returns the relief of a wall, a roof or a ground. `name` is the name of one of wall_kinds(). Cost: about 30 ns a
/// texel.
Relief wall_relief(std::string_view name, int size, std::uint64_t seed, const Job& job);
/// Returns how the relief becomes images.
Finish wall_finish(std::string_view name, const Tint& tint);

}  // namespace seedmesh::texture
