#include "core/generators/world/palette.h"

#include <algorithm>
#include <array>

#include "core/base/math.h"
#include "core/generators/world/canopy.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/octaves.h"
#include "core/generators/world/plant_layer.h"
#include "core/generators/world/resolved.h"
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

constexpr double widest_bank_spacing = 128;  ///< metres between samples that show green banks
constexpr double widest_verge_spacing = 8;  ///< metres between samples that show the bare ground beside roads
constexpr double widest_canopy_spacing = widest_plants / tile_cells;

/// Variations of the ground from 2 km to 20 m, about -1 to 1; without those finer than samples can show.
double patches_at(const World& world, double east, double north, double spacing) {
  constexpr std::array<std::array<double, 2>, 4> octaves{{{2100, 0.5}, {520, 0.5}, {140, 0.55}, {37, 0.35}}};
  std::size_t count = 0;
  Octaves<4> patches;
  for (; count < octaves.size() && resolved_share(spacing, octaves[count][0]) > 0; ++count)
    patches.add(world.key ^ (0xC0105U + count), east, north, 1 / octaves[count][0]);
  if (count == 0) return 0;
  patches.compute_values();
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k)
    sum += resolved_share(spacing, octaves[k][0]) * octaves[k][1] * patches.value(k);
  return sum;
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
                                         const GroundSample& sample, const glm::dvec2& at, double steepness,
                                         double spacing) {
  const double east = at.x, north = at.y;
  const Climate climate = climate_at(world, east, north, sample.height);
  const double patch = patches_at(world, east, north, spacing);
  const double banks =
      spacing <= widest_bank_spacing ? 1 - smooth_step(sample.shore + 25 * patch, 8, 110) : 0;
  const double moisture = climate.moisture + 0.07 * patch + 0.28 * banks;
  Shade bare_soil = mixed(colors.dry, colors.sand, 0.75 * smooth_step(patch, -0.1, 0.7));
  bare_soil = mixed(bare_soil, colors.rock, 0.4 * smooth_step(-patch, 0.15, 0.8));
  Shade shade = mixed(bare_soil, colors.grass, smooth_step(moisture, 0.2, 0.46));
  shade = mixed(shade, colors.forest, 0.45 * smooth_step(moisture, 0.5, 0.85));
  shade = mixed(shade, colors.dry, 0.6 * smooth_step(-climate.temperature + patch, -1, 5));
  if (world.has(Layer::plants)) {
    const Wood wood = wood_at(world, sample, climate, east, north, spacing);
    // below crowns the floor of the wood, from afar the crowns themselves
    const double dark = spacing > widest_canopy_spacing ? 0.52 : 0.4;
    const Shade crowns{dark * wood.color[0], dark * wood.color[1], dark * wood.color[2]};
    shade = mixed(shade, spacing > widest_canopy_spacing ? crowns : mixed(crowns, colors.forest, 0.3),
                  0.95 * smooth_step(wood.cover, 0.06, 0.65));
  }
  if (sample.field >= 0) {
    const Shade& crop = colors.fields[static_cast<std::size_t>(sample.field)];
    shade = mixed(shade, sample.is_hedge ? colors.forest : crop, 0.85);
  }
  if (spacing <= widest_verge_spacing) {
    const double verge = 1 - smooth_step(sample.road + 0.4 * patch, 0.2, 3.5);
    shade = mixed(shade, colors.dry, (sample.is_town ? 0.8 : 0.6) * verge);
  }
  const double bare = smooth_step(1 - steepness + 0.02 * patch, 0.1, 0.24);
  shade = mixed(shade, colors.rock, bare);
  if (world.params.relief.sea) {
    const double above = sample.height - world.params.relief.sea_level;
    shade = mixed(shade, colors.sand, 1 - smooth_step(above + 0.8 * patch, 0.9, 3.2));
  }
  const double snow =
      smooth_step(-climate.temperature + 1.2 * patch, 3, 6) * (1 - smooth_step(1 - steepness, 0.25, 0.5));
  shade = mixed(shade, colors.snow, snow);
  const double light = 1 + 0.11 * patch;
  shade = {shade.red * light, shade.green * light, shade.blue * light};
  if (world.params.relief.sea) {
    const double deep = 1.5 + 0.02 * spacing, below = world.params.relief.sea_level - sample.height;
    shade = mixed(shade, colors.water, smooth_step(below, 0, deep));
  }
  if (spacing <= widest_textured_spacing) {
    constexpr double by = 1 / ground_texture_mean;
    shade = {by * shade.red, by * shade.green, by * shade.blue};
  }
  return {byte_of(shade.red), byte_of(shade.green), byte_of(shade.blue), 255};
}

}  // namespace seedmesh::world
