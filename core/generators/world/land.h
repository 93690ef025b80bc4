#pragma once
/// The height of the land before rivers and lakes: continents, mountain ranges, hills, gullies and detail. Each is a
/// function of the position alone, so land has no borders.
///
/// Ridged noise after Musgrave (in Ebert et al. 2003, "Texturing and Modeling", chapter 16).
#include "core/generators/world/noise.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

/// The land at wavelengths of 1.2 km and more, in metres above zero, and what finer wavelengths depend on.
struct Land {
  Slope height;
  double ruggedness = 0;  ///< 0 on plains to 1 in the greatest mountains
  double coast = 0;       ///< below 0 is the sea, above 0 land; about -1 to 1
};
Land land_at(const World& world, double east, double north);

/// What gullies and finer wavelengths add. `land` is the ground with its slope, after rivers.
double detail_at(const World& world, const Land& land, double east, double north);

/// Moisture 0..1 and temperature in degrees Celsius of a position at a height.
struct Climate {
  double moisture = 0, temperature = 0;
};
Climate climate_at(const World& world, double east, double north, double height);

/// Bounds of the height of any ground of the world, without skirts and plants.
double lowest_ground(const World& world);
double highest_ground(const World& world);

}  // namespace seedmesh::world
