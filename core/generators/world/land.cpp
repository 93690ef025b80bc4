#include "core/generators/world/land.h"

#include <algorithm>
#include <cmath>

#include "core/generators/world/gullies.h"

namespace seedmesh::world {
namespace {

constexpr double detail_slope = 0.035;  ///< amplitude of an octave by its wavelength

enum class Noise : std::uint64_t { coast = 1, belts, ranges, hills, detail, gullies, moisture, temperature };

std::uint64_t key_of(const World& world, Noise noise, int octave) {
  return key_at(key_at(world.key, static_cast<std::uint64_t>(noise)), static_cast<std::uint64_t>(octave));
}

Slope constant(double value) { return {value, 0, 0}; }

/// Sum of octaves that halve in wavelength and amplitude, within about -1 to 1.
Slope sum_of_octaves(const World& world, Noise noise, double wavelength, int count, double east,
                     double north) {
  Slope sum;
  double amplitude = 1, total = 0;
  for (int k = 0; k < count; ++k, amplitude *= 0.5, wavelength *= 0.5) {
    sum = sum + octave(key_of(world, noise, k), east, north, wavelength) * amplitude;
    total += amplitude;
  }
  return sum * (1.5 / total);
}

/// 1 at crests and falling to both sides, rounded within `k` of the crest.
Slope crest(const Slope& n, double k) {
  const double root = std::sqrt(n.value * n.value + k * k);
  return applied(n, 1 + k - root, -n.value / root);
}

/// Mountain ranges, about 0 to 1. Finer ridges are stronger where coarser ones are high.
Slope ranges_at(const World& world, double east, double north, std::array<float, range_octaves>& weights) {
  const double k = 0.02 + 0.35 * (1 - world.params.relief.ridges);
  Slope sum, weight = constant(1);
  double amplitude = 1, wavelength = range_wavelength, total = 0;
  for (int n = 0; n < range_octaves; ++n, amplitude *= range_fall, wavelength *= 0.5) {
    weights[static_cast<std::size_t>(n)] = static_cast<float>(weight.value);
    const Slope c = crest(octave(key_of(world, Noise::ranges, n), east, north, wavelength), k);
    const Slope part = c * c * weight;
    sum = sum + part * amplitude;
    total += amplitude;
    weight = part.value > 1 ? constant(1) : part;
  }
  return sum * (1 / total);
}

/// Steps of layered rock: flat and steep parts in turn.
Slope terraced(const Slope& h, double share) {
  if (share <= 0) return h;
  constexpr double step = terrace_step;
  const double level = std::floor(h.value / step), t = h.value / step - level;
  const double s = t * t * t * (t * (t * 6 - 15) + 10), ds = 30 * t * t * (t * (t - 2) + 1);
  return h * (1 - share) + applied(h, step * (level + s), ds) * share;
}

}  // namespace

Land land_at(const World& world, double east, double north) {
  const WorldRelief& relief = world.params.relief;
  const Slope coast =
      sum_of_octaves(world, Noise::coast, relief.continents, 4, east, north) + constant(world.land_bias);
  const Slope on_land = smooth_step(coast, -0.04, 0.3);
  const Slope belt = sum_of_octaves(world, Noise::belts, 64000, 2, east, north);
  const Slope rugged = smooth_step(belt, -0.25, 0.55) * on_land;
  Land land{{}, rugged.value, coast.value, {}};
  Slope height = coast * (coast.value < 0 ? sea_fall : land_rise);
  if (relief.mountains > 0 && rugged.value > 0) {
    height = height + ranges_at(world, east, north, land.ridges) * rugged * (1.6 * relief.mountains);
  }
  if (relief.hills > 0) {
    const Slope hills = sum_of_octaves(world, Noise::hills, hill_wavelength, hill_octaves, east, north);
    height = height + (hills + constant(0.35)) * (on_land * 0.85 + constant(0.15)) * relief.hills;
  }
  height = terraced(height, relief.terraces);
  height.value += relief.sea_level;
  for (float& ridge : land.ridges) ridge *= static_cast<float>(rugged.value);
  land.height = height;
  return land;
}

double detail_share(const World& world, double ruggedness) {
  const WorldRelief& relief = world.params.relief;
  return detail_slope * (0.06 + 0.94 * ruggedness * std::min(1.0, relief.mountains / 900) +
                         0.3 * std::min(1.0, relief.hills / 150));
}

double detail_at(const World& world, const Land& land, double east, double north) {
  const WorldRelief& relief = world.params.relief;
  const double strength = detail_share(world, land.ruggedness);
  double sum = 0, wavelength = detail_wavelength;
  for (int n = 0; n < detail_octaves; ++n, wavelength *= 0.5) {
    sum += octave(key_of(world, Noise::detail, n), east, north, wavelength).value * wavelength;
  }
  const double gullies =
      relief.gullies <= 0 ? 0 : gullies_at(key_of(world, Noise::gullies, 0), land.height, east, north);
  return sum * strength + 1.4 * relief.gullies * gullies;
}

Biome biome_of(const Climate& climate) {
  const auto [moisture, temperature] = climate;
  if (temperature < -8) return Biome::ice;
  if (temperature < -1) return Biome::tundra;
  if (temperature < 5) return moisture < 0.25 ? Biome::steppe : Biome::taiga;
  if (temperature < 20)
    return moisture < 0.2    ? Biome::desert
           : moisture < 0.35 ? Biome::steppe
           : moisture < 0.48 ? Biome::grassland
                             : Biome::forest;
  return moisture < 0.25 ? Biome::desert : moisture < 0.6 ? Biome::savanna : Biome::rainforest;
}

Climate climate_at(const World& world, double east, double north, double height) {
  const WorldClimate& climate = world.params.climate;
  const double wet = sum_of_octaves(world, Noise::moisture, 31000, 3, east, north).value;
  const double warm = octave(key_of(world, Noise::temperature, 0), east, north, 170000).value;
  const double above = std::max(0.0, height - world.params.relief.sea_level);
  return {std::clamp(climate.moisture + 0.55 * climate.variation * wet, 0.0, 1.0),
          climate.temperature + 9 * climate.variation * warm - 0.0065 * above};
}

}  // namespace seedmesh::world
