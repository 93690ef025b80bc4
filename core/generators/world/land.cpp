#include "core/generators/world/land.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"
#include "core/generators/world/gullies.h"
#include "core/generators/world/octaves.h"

namespace seedmesh::world {
namespace {

constexpr double detail_slope = 0.035;  ///< amplitude of an octave by its wavelength

enum class Noise : std::uint64_t { coast = 1, belts, ranges, hills, detail, gullies, moisture, temperature };

std::uint64_t key_of(std::uint64_t key, Noise noise, int octave) {
  return key_at(key_at(key, static_cast<std::uint64_t>(noise)), static_cast<std::uint64_t>(octave));
}

Slope constant(double value) { return {value, 0, 0}; }

/// Sum of octaves that halve in wavelength and amplitude, within about -1 to 1.
template <std::size_t lanes>
Slope sum_of(const Octaves<lanes>& octaves, std::size_t first, std::size_t count) {
  Slope sum;
  double amplitude = 1, total = 0;
  for (std::size_t k = 0; k < count; ++k, amplitude *= 0.5) {
    sum = sum + octaves.slope(first + k) * amplitude;
    total += amplitude;
  }
  return sum * (1.5 / total);
}

template <std::size_t lanes, std::size_t count>
void add(Octaves<lanes>& octaves, const std::array<std::uint64_t, count>& keys, double east, double north,
         double by) {
  for (const std::uint64_t key : keys) {
    octaves.add(key, east, north, by);
    by *= 2;
  }
}

/// 1 at crests and falling to both sides, rounded within `k` of the crest.
Slope crest(const Slope& n, double k) {
  const double root = std::sqrt(n.value * n.value + k * k);
  return applied(n, 1 + k - root, -n.value / root);
}

/// Mountain ranges, about 0 to 1. Finer ridges are stronger where coarser ones are high.
Slope ranges_of(const Octaves<8>& octaves, double rounding, std::array<float, range_octaves>& weights) {
  Slope sum, weight = constant(1);
  double amplitude = 1, total = 0;
  for (std::size_t n = 0; n < range_octaves; ++n, amplitude *= range_fall) {
    weights[n] = static_cast<float>(weight.value);
    const Slope c = crest(octaves.slope(n), rounding);
    const Slope part = c * c * weight;
    sum = sum + part * amplitude;
    total += amplitude;
    weight = part.value > 1 ? constant(1) : part;
  }
  return sum * (1 / total);
}

/// The height of the sea floor and of the land by their distance from the coast, with a continuous slope.
Slope coast_height(const Slope& coast) {
  const double c = coast.value;
  if (c <= -coast_blend) return coast * sea_fall;
  if (c >= coast_blend) return coast * land_rise;
  const double from = c + coast_blend, bend = (land_rise - sea_fall) / (4 * coast_blend);
  return applied(coast, sea_fall * c + bend * from * from, sea_fall + 2 * bend * from);
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

NoiseKeys noise_keys(std::uint64_t key) {
  NoiseKeys keys;
  const auto fill = [&](auto& list, Noise noise) {
    for (std::size_t k = 0; k < list.size(); ++k) list[k] = key_of(key, noise, static_cast<int>(k));
  };
  fill(keys.coast, Noise::coast);
  fill(keys.belts, Noise::belts);
  fill(keys.ranges, Noise::ranges);
  fill(keys.hills, Noise::hills);
  fill(keys.detail, Noise::detail);
  fill(keys.moisture, Noise::moisture);
  keys.temperature = key_of(key, Noise::temperature, 0);
  const std::uint64_t gullies = key_of(key, Noise::gullies, 0);
  for (std::size_t k = 0; k < keys.gullies.size(); ++k) keys.gullies[k] = key_at(gullies, k);
  return keys;
}

SEEDMESH_WIDE Land land_at(const World& world, double east, double north) {
  const WorldRelief& relief = world.params.relief;
  Octaves<8> wide;
  add(wide, world.noise.coast, east, north, 1 / relief.continents);
  add(wide, world.noise.belts, east, north, 1 / belt_wavelength);
  wide.compute();
  const Slope coast = sum_of(wide, 0, 4) + constant(world.land_bias);
  const Slope on_land = smooth_step(coast, -0.04, 0.3);
  const Slope rugged = smooth_step(sum_of(wide, 4, 2), -0.25, 0.55) * on_land;
  Land land{{}, rugged.value, coast.value, {}};
  Slope height = coast_height(coast);
  Slope hills;
  if (relief.mountains > 0 && rugged.value > 0) {
    // all octaves together fill the lanes
    Octaves<8> high;
    add(high, world.noise.ranges, east, north, 1 / range_wavelength);
    add(high, world.noise.hills, east, north, 1 / hill_wavelength);
    high.compute();
    const double rounding = 0.02 + 0.35 * (1 - relief.ridges);
    height = height + ranges_of(high, rounding, land.ridges) * rugged * (1.6 * relief.mountains);
    hills = sum_of(high, range_octaves, hill_octaves);
  } else if (relief.hills > 0) {
    Octaves<4> low;
    add(low, world.noise.hills, east, north, 1 / hill_wavelength);
    low.compute();
    hills = sum_of(low, 0, hill_octaves);
  }
  if (relief.hills > 0)
    height = height + (hills + constant(0.35)) * (on_land * 0.85 + constant(0.15)) * relief.hills;
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

SEEDMESH_WIDE double detail_at(const World& world, const Land& land, double east, double north) {
  const WorldRelief& relief = world.params.relief;
  const double strength = detail_share(world, land.ruggedness);
  Octaves<8> octaves;
  add(octaves, world.noise.detail, east, north, 1 / detail_wavelength);
  octaves.compute_values();
  double sum = 0, wavelength = detail_wavelength;
  for (std::size_t n = 0; n < detail_octaves; ++n, wavelength *= 0.5) sum += octaves.value(n) * wavelength;
  const double gullies = relief.gullies <= 0 ? 0 : gullies_at(world.noise.gullies, land.height, east, north);
  return sum * strength + 1.4 * relief.gullies * gullies;
}

Biome biome_of(const Climate& climate) {
  const auto [moisture, temperature] = climate;
  if (temperature < -8) return Biome::ice;
  if (temperature < -1) return Biome::tundra;
  if (temperature < 5) return moisture < 0.25 ? Biome::steppe : Biome::taiga;
  if (temperature < 20) {
    return moisture < 0.2    ? Biome::desert
           : moisture < 0.35 ? Biome::steppe
           : moisture < 0.48 ? Biome::grassland
                             : Biome::forest;
  }
  return moisture < 0.25 ? Biome::desert : moisture < 0.6 ? Biome::savanna : Biome::rainforest;
}

SEEDMESH_WIDE Climate climate_at(const World& world, double east, double north, double height) {
  const WorldClimate& climate = world.params.climate;
  Octaves<4> octaves;
  add(octaves, world.noise.moisture, east, north, 1.0 / 31000);
  octaves.add(world.noise.temperature, east, north, 1.0 / 170000);
  octaves.compute_values();
  const double wet = (octaves.value(0) + 0.5 * octaves.value(1) + 0.25 * octaves.value(2)) * (1.5 / 1.75);
  const double above = std::max(0.0, height - world.params.relief.sea_level);
  return {std::clamp(climate.moisture + 0.55 * climate.variation * wet, 0.0, 1.0),
          climate.temperature + 9 * climate.variation * octaves.value(3) - 0.0065 * above};
}

}  // namespace seedmesh::world
