#pragma once
/// The height of the land before rivers and lakes: continents, mountain ranges, hills, gullies and detail. Each is a
/// function of the position alone, so tiles agree at their borders.
///
/// Ridged noise after Musgrave (in Ebert et al. 2003, "Texturing and Modeling", chapter 16).
#include <array>

#include "core/generators/world/noise.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

constexpr double belt_wavelength = 64000;   ///< metres; wavelength of the belts that have mountains
constexpr double range_wavelength = 22000;  ///< metres; wavelength of the widest mountain ridges
constexpr double range_fall = 0.48;         ///< amplitude of a ridge divided by that of one twice as wide
constexpr double hill_wavelength = 5200;
constexpr double detail_wavelength = 720;
constexpr double land_rise = 170, sea_fall = 520;  ///< metres at a coast value of 1
/// Coast values up to which the fall of the sea floor becomes the rise of the land. Without this transition the slope
/// would jump at 0, and gullies, which follow the slope, would have steps there.
constexpr double coast_blend = 0.02;
constexpr double terrace_step = 60;  ///< metres

/// The land at wavelengths of 1.2 km and more, and the values on which finer wavelengths depend. Heights are metres
/// above zero.
struct Land {
  Slope height;
  double ruggedness = 0;  ///< 0 on plains to 1 in the greatest mountains
  double coast = 0;       ///< below 0 is the sea, above 0 land; about -1 to 1
  /// For each octave of ridges, its share of its full amplitude.
  std::array<float, range_octaves> ridges{};
};
/// Returns the land at a position.
Land land_at(const World& world, double east, double north);

/// Returns the amplitude of an octave of detail, divided by its wavelength.
double detail_share(const World& world, double ruggedness);

/// Returns the height in metres that gullies and finer wavelengths add. `land` is the ground with its slope, after
/// rivers.
double detail_at(const World& world, const Land& land, double east, double north);

/// Moisture 0..1 and temperature in degrees Celsius of a position at a height.
struct Climate {
  double moisture = 0, temperature = 0;
};
/// In the order of the schema.
enum class Biome { ice, tundra, taiga, steppe, grassland, forest, desert, savanna, rainforest };
/// The climates at which biome_of() changes.
constexpr std::array<double, 4> temperature_limits{-8, -1, 5, 20};
constexpr std::array<double, 5> moisture_limits{0.2, 0.25, 0.35, 0.48, 0.6};
/// Returns the biome for a temperature and a moisture, roughly as in Whittaker 1975 ("Communities and Ecosystems").
Biome biome_of(const Climate& climate);

/// Returns the climate at a position and a height in metres.
Climate climate_at(const World& world, double east, double north, double height);

}  // namespace seedmesh::world
