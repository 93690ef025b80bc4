#pragma once
/// The texture of the plain forms of plants: leaves, branches and bark in grey, which vertex colours tint, with alpha.
#include <memory>

#include "core/generators/world/shared_image.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

/// A rectangle of texture coordinates: u to the right, v down. Cells with alpha end 4 texels before their neighbours, so that
/// filters do not mix these in.
struct TextureCell {
  double left = 0, top = 0, right = 1, bottom = 1;
};

/// Leaves without gaps; for the insides of crowns.
inline constexpr TextureCell dense_leaves{0.01, 0.01, 0.49, 0.49};
/// Leaves in a disc with gaps, transparent around it.
inline constexpr TextureCell leaf_cluster{0.516, 0.016, 0.984, 0.484};
/// The branch of a conifer, from its base at the left to its tip at the right.
inline constexpr TextureCell conifer_branch{0.016, 0.516, 0.484, 0.984};
/// The leaf of a palm, from its base at the left to its tip at the right.
inline constexpr TextureCell palm_leaf{0.516, 0.516, 0.984, 0.884};
/// An opaque white area, for stems.
inline constexpr TextureCell plain_surface{0.55, 0.965, 0.95, 0.97};

/// Mean light of the opaque texels of leaves; vertex colours are divided by it.
constexpr double leaf_texture_mean = 0.55;

/// Returns the texture, grey with alpha, from the store; makes it if the store has none. All worlds have the same.
std::shared_ptr<const SharedImage> leaf_texture(const World& world, const Job& job);

}  // namespace seedmesh::world
