#pragma once
/// Houses of a settlement, in rows along its roads. A house belongs to the tile that holds its middle.
#include <memory>
#include <vector>

#include "core/generators/world/glb.h"
#include "core/generators/world/roads.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

struct House {
  double east = 0, north = 0;            ///< of its middle, absolute
  double x = 1, y = 0;                   ///< direction of the ridge, east and north
  double length = 0, depth = 0;          ///< half of the plan along and across the ridge
  double low = 0, eaves = 0, ridge = 0;  ///< heights; `low` is below the ground
};

constexpr double house_reach = 13;   ///< metres from the middle of a house to its corners at most
constexpr double most_cellar = 4;    ///< metres from the ground at its middle to its lowest corner at most
constexpr double house_height = 14;  ///< metres from the ground at its middle to its ridge at most

struct Plan {
  std::vector<House> houses;
  std::uint64_t bytes() const { return sizeof(Plan) + houses.size() * sizeof(House); }
};

/// From the store, or made in some milliseconds after the roads of the settlement.
std::shared_ptr<const Plan> plan_of(const World& world, const Site& site, Job& job);
/// Houses with their middle within `reach` of a rectangle.
std::vector<House> houses_near(const World& world, const Rectangle& box, double reach, Job& job);

/// Walls and a gable roof for each house whose middle is in the tile.
TileMesh house_mesh(const World& world, const TileFrame& frame, const std::vector<House>& houses,
                    double base);

}  // namespace seedmesh::world
