#pragma once
/// Woods seen from afar: a surface over the crowns, from edge to edge, with a texture of crowns. Its positions are
/// those of the terrain's samples, and its edges follow the cover of woods between them, so that no grid is visible.
#include <array>

#include "core/generators/world/glb.h"
#include "core/generators/world/shared_image.h"
#include "core/generators/world/terrain_grid.h"

namespace seedmesh::world {

/// Whether the crowns of a class are so large and dense that a wood of it is drawn as a surface.
bool has_canopy(const WorldClass& plant);

/// The woods at a position: the mean of the classes of plants, weighted by their cover.
struct Wood {
  double cover = 0;               ///< 0 to 1, for classes with a canopy
  double height = 0;              ///< height of the crowns, metres
  std::array<double, 3> color{};  ///< linear colour of the crowns
};
/// Returns the woods at a position, given as metres east and north. `spacing`: distance of the samples in metres;
/// cover that varies over shorter distances is averaged.
Wood wood_at(const World& world, const GroundSample& sample, const Climate& climate, double east,
             double north, double spacing);

constexpr double wood_edge = 0.45;  ///< cover above which a position belongs to a wood

/// Adds the surface of woods of a tile.
void add_canopy(Glb& glb, const World& world, const TileFrame& frame, const TileGround& ground, Job& job);

/// Returns a square of crowns from above in grey, which repeats, from the store; makes it if the store has none. All worlds have
/// the same.
std::shared_ptr<const SharedImage> canopy_texture(const World& world, Job& job);

}  // namespace seedmesh::world
