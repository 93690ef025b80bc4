#pragma once
/// Houses of a settlement, in rows along its roads and lanes, a church in its middle, and farms around it. A house
/// belongs to the tile that contains its middle.
#include <array>
#include <memory>
#include <vector>

#include "core/generators/world/asset.h"
#include "core/generators/world/glb.h"
#include "core/generators/world/roads.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

struct Town;

struct House {
  double east = 0, north = 0;            ///< its middle, absolute
  double x = 1, y = 0;                   ///< direction of the ridge, east and north
  double length = 0, depth = 0;          ///< half of the plan along and across the ridge
  double low = 0, eaves = 0, ridge = 0;  ///< heights; `low` is below the ground
  double top = 0;                        ///< height of the highest chimney or tower
  enum Kind : std::uint8_t { dwelling, barn, church, wall } kind = dwelling;
  bool is_on_lot = false;  ///< whether it is on a lot of a town
  int front = 0;           ///< side of its front, seen along the ridge: -1 right, 1 left, 0 no side
  /// Brightness of the colours of walls and roof; `warmth` shifts the colour of the walls to yellow or white.
  float wall_light = 1, roof_light = 1, warmth = 0;
  int model = -1;                   ///< index into WorldSettlements::houses; -1: walls and a gable roof
  double scale = 1, floor = 0;      ///< scale of the model, and the height of its foot
  std::array<float, 2> turn{0, 1};  ///< rotation of the model, as Instances::add() takes it
};

/// Greatest height of the ground at its middle above its lowest corner, metres.
constexpr double most_cellar = 4;

/// Bounds of the houses of a world: metres from the middle to the corners, and from the ground there to the ridge.
/// Greater models are scaled down. 0 in a world without settlements.
struct HouseExtent {
  double across = 0, up = 0;
};
/// Returns the bounds of the houses of a world.
HouseExtent house_extent(const World& world);

/// Returns the model of a house from the store; makes it if the store has none.
std::shared_ptr<const Asset> house_asset(const World& world, int number, Job& job);

struct Plan {
  std::vector<House> houses;
  std::vector<House> walls;  ///< pieces and towers of the wall of a town, and the fountain of its square
  std::uint64_t bytes() const { return sizeof(Plan) + (houses.size() + walls.size()) * sizeof(House); }
};

/// Returns the wall of a town, if it has one. `ground` has the roads and streets around the settlement.
std::vector<House> town_walls(const World& world, const Site& site, const Town& town, const Ground& ground);

/// Returns the houses of a settlement from the store. If the store has none, makes them in some milliseconds,
/// after the roads of the settlement.
std::shared_ptr<const Plan> plan_of(const World& world, const Site& site, Job& job);
/// Returns the houses and pieces of walls whose middle is within `reach` of a rectangle.
std::vector<House> houses_near(const World& world, const Rectangle& box, double reach, Job& job);

/// Adds the houses whose middle is in the tile. In tiles of up to 128 m they are models, or walls and a gable roof.
/// In tiles of up to 512 m all are walls and a roof. In tiles of up to 2 km they are boxes. In tiles of 4 km and 8 km
/// there is one prism for each square with 1/64 of the tile's side. Towns have boxes in tiles of 512 m. They have
/// prisms for squares of 40 m in tiles of 1 km, and for squares of 64 m in tiles of 2 km.
void add_houses(Glb& glb, const World& world, const TileFrame& frame, double base, Job& job);

}  // namespace seedmesh::world
