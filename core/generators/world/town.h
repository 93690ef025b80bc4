#pragma once
/// Towns: settlements whose streets, blocks and lots the generator city plans on the ground of the world. The plan
/// depends on the settlement alone: on the ground and the roads within its radius.
#include <array>
#include <memory>
#include <vector>

#include "core/generators/world/lanes.h"

namespace seedmesh::city {
struct CityPlan;
}

namespace seedmesh::world {

/// The rectangle of a house on its lot.
struct TownHouse {
  double east = 0, north = 0;   ///< its middle, absolute
  double turn = 0;              ///< degrees, counter-clockwise from above; at 0 the front faces south
  double width = 0, depth = 0;  ///< sides along and across the front, metres
  int floors = 1;
  std::uint64_t key = 0;
};

struct Town {
  std::vector<Lane> streets;  ///< streets without the roads of the world, which pass through
  std::vector<TownHouse> houses;
  bool has_church = false;
  double church_east = 0, church_north = 0;
  bool has_square = false;
  double square_east = 0, square_north = 0;    ///< the middle of the paved square
  std::vector<std::array<double, 2>> outline;  ///< counter-clockwise, absolute
  bool is_built() const { return !streets.empty(); }
  std::uint64_t bytes() const;
};

constexpr double square_radius = 19;  ///< metres; of the corners of the square of a town

/// Returns the corners of the square of a town, absolute, counter-clockwise.
std::vector<std::array<double, 2>> square_of(const Town& town);

/// Metres by which the square of ground and roads that a town plan reads extends beyond the radius of the town.
constexpr double town_margin = 60;
constexpr double town_lattice = 10;  ///< metres between samples of the ground for the plan

/// Returns the rules of towns: those of WorldTowns::city, or built-in ones.
CityParams town_rules(const WorldParams& params);
/// Adds errors at /settlements/towns for parameters of the city that have no effect in a world.
void check_towns(const WorldParams& params, std::vector<Issue>& issues);
/// Returns the number of floors of the highest houses of towns.
int most_floors(const World& world);

/// Returns the plan of a town, in metres around the middle of the settlement. Returns Code::invalid without
/// issues if the ground leaves too little area.
Result<city::CityPlan> town_plan(const World& world, const Site& site, Job& job);

/// Returns the town of a settlement from the store. If the store has none, makes it in some tens of milliseconds. The
/// town is empty if Site::is_town is false or the ground leaves too little area: such settlements are villages.
std::shared_ptr<const Town> town_of(const World& world, const Site& site, Job& job);

}  // namespace seedmesh::world
