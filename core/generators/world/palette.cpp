#include "core/generators/world/palette.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/world/octaves.h"
#include "core/model/model.h"

namespace seedmesh::world {
namespace {

Shade shade_of(const Color& color) {
  return {static_cast<double>(linear_of_srgb(color.red)), static_cast<double>(linear_of_srgb(color.green)),
          static_cast<double>(linear_of_srgb(color.blue))};
}

Shade mixed(const Shade& a, const Shade& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(math::to_int32(std::clamp(value, 0.0, 1.0) * 255 + 0.5));
}

}  // namespace

std::array<std::uint8_t, 4> linear_color(const Color& color) {
  const Shade shade = shade_of(color);
  return {byte_of(shade.red), byte_of(shade.green), byte_of(shade.blue), 255};
}

GroundColors::GroundColors(const World& world) {
  const WorldColors& colors = world.params.colors;
  dry = shade_of(colors.dry);
  grass = shade_of(colors.grass);
  forest = shade_of(colors.forest);
  rock = shade_of(colors.rock);
  sand = shade_of(colors.sand);
  snow = shade_of(colors.snow);
  water = shade_of(colors.water);
  for (const Color& color : world.params.fields.colors) fields.push_back(shade_of(color));
}

std::array<std::uint8_t, 4> ground_color(const World& world, const GroundColors& colors,
                                         const GroundSample& sample, double east, double north,
                                         double steepness, double spacing) {
  const Climate climate = climate_at(world, east, north, sample.height);
  Octaves<4> patches;
  patches.add(world.key ^ 0xC0105U, east, north, 1.0 / 140);
  patches.add(world.key ^ 0xC0106U, east, north, 1.0 / 37);
  patches.compute_values();
  const double patch = patches.value(0) + 0.5 * patches.value(1);
  const double moisture = climate.moisture + 0.05 * patch;
  Shade shade = mixed(colors.dry, colors.grass, smooth_step(moisture, 0.22, 0.48));
  shade = mixed(shade, colors.forest, smooth_step(moisture, 0.5, 0.8));
  shade = mixed(shade, colors.dry, 0.6 * smooth_step(-climate.temperature + patch, -4, 2));
  if (sample.field >= 0) {
    const Shade& crop = colors.fields[static_cast<std::size_t>(sample.field)];
    shade = mixed(shade, sample.is_hedge ? colors.forest : crop, 0.85);
  }
  const double bare = smooth_step(1 - steepness + 0.02 * patch, 0.1, 0.24);
  shade = mixed(shade, colors.rock, bare);
  if (world.params.relief.sea) {
    const double above = sample.height - world.params.relief.sea_level;
    shade = mixed(shade, colors.sand, 1 - smooth_step(above + patch, 1.5, 5));
  }
  const double snow =
      smooth_step(-climate.temperature + 1.2 * patch, 3, 6) * (1 - smooth_step(1 - steepness, 0.25, 0.5));
  shade = mixed(shade, colors.snow, snow);
  const double light = 1 + 0.08 * patch;
  shade = {shade.red * light, shade.green * light, shade.blue * light};
  if (world.params.relief.sea) {
    const double deep = 1.5 + 0.02 * spacing, below = world.params.relief.sea_level - sample.height;
    shade = mixed(shade, colors.water, smooth_step(below, 0, deep));
  }
  return {byte_of(shade.red), byte_of(shade.green), byte_of(shade.blue), 255};
}

}  // namespace seedmesh::world
