#pragma once
/// How far the ground can be from the terrain of a tile, as a function of the tile's side and of the ground around.
/// The numbers are bounds of deviations that were measured on walks through all presets.
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

/// What the ground of a tile is like.
struct Roughness {
  double ruggedness = 0;      ///< the greatest of Land::ruggedness
  bool is_near_water = true;  ///< a river or lake is in the tile or close to it
};

/// Metres; rises with the side. Saturates where a tile is wider than the widest mountains.
double error_of(const World& world, double side, const Roughness& roughness);

/// Metres that the skirt of a tile hangs down: the deviation of borders of tiles three levels coarser.
double skirt_depth(const World& world, double side);

}  // namespace seedmesh::world
