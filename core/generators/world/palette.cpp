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
constexpr double hollow_share =
    0.9;  ///< share of light that a hollow as deep as the distance of samples loses

/// Variations of the ground, about -1 to 1; without those finer than samples can show.
struct Patches {
  double broad = 0;  ///< from 2 km to 37 m, which moves the edges of all kinds of ground
  double hue = 0;    ///< from 900 m to 9 m, dry or lush
  double fine = 0;   ///< from 24 m down to the samples
};

struct PatchOctave {
  double wavelength = 0, amplitude = 0;
};
constexpr std::array<PatchOctave, 8> patch_octaves{
    {{2100, 0.5}, {520, 0.5}, {140, 0.55}, {37, 0.35}, {900, 0.5}, {230, 0.5}, {64, 0.45}, {15, 0.7}}};
constexpr std::size_t broad_octaves = 4;

Patches patches_at(const World& world, double east, double north, double spacing) {
  Octaves<8> noise;
  std::array<double, patch_octaves.size()> shares{};
  bool is_any = false;
  for (std::size_t k = 0; k < patch_octaves.size(); ++k) {
    shares[k] = patch_octaves[k].amplitude * resolved_share(spacing, patch_octaves[k].wavelength);
    is_any |= shares[k] > 0;
    noise.add(world.key ^ (0xC0105U + k), east, north, 1 / patch_octaves[k].wavelength);
  }
  Patches patches;
  if (is_any) noise.compute_values();
  for (std::size_t k = 0; is_any && k + 1 < patch_octaves.size(); ++k)
    (k < broad_octaves ? patches.broad : patches.hue) += shares[k] * noise.value(k);
  if (is_any) patches.fine = shares.back() * noise.value(patch_octaves.size() - 1);
  // a number of the position, the same at all levels that have a sample there
  Rng own(
      cell_key(world.key ^ 0x4F574E4CU, math::to_int64(std::floor(east)), math::to_int64(std::floor(north))));
  patches.fine += own.uniform(-0.5, 0.5);
  return patches;
}

/// A colour, and how much of it is of each kind of ground.
class Cover {
 public:
  Cover(const Shade& shade, GroundKind kind) : shade_(shade) { of(kind) = 1; }
  /// Covers a share of it.
  void cover(const Shade& shade, GroundKind kind, double share) {
    shade_ = mixed(shade_, shade, share);
    for (double& each : shares_) each *= 1 - share;
    of(kind) += share;
  }
  void tint(const Shade& by) {
    shade_ = {shade_.red * by.red, shade_.green * by.green, shade_.blue * by.blue};
  }
  const Shade& shade() const { return shade_; }
  GroundKind kind() const {
    return static_cast<GroundKind>(std::max_element(shares_.begin(), shares_.end()) - shares_.begin());
  }
  double share(GroundKind kind) const { return shares_[static_cast<std::size_t>(kind)]; }

 private:
  double& of(GroundKind kind) { return shares_[static_cast<std::size_t>(kind)]; }
  Shade shade_;
  std::array<double, ground_kinds> shares_{};
};

/// Soil, grass and the floor of woods by climate.
Cover cover_of(const World& world, const GroundColors& colors, const GroundSample& sample,
               const glm::dvec2& at, double spacing, const Climate& climate, double patch) {
  const double banks =
      spacing <= widest_bank_spacing ? 1 - smooth_step(sample.shore + 25 * patch, 8, 110) : 0;
  const double moisture = climate.moisture + 0.07 * patch + 0.28 * banks;
  Cover ground(colors.dry, GroundKind::soil);
  ground.cover(colors.sand, GroundKind::sand, 0.75 * smooth_step(patch, -0.1, 0.7));
  ground.cover(colors.rock, GroundKind::soil, 0.4 * smooth_step(-patch, 0.15, 0.8));
  ground.cover(colors.grass, GroundKind::grass, smooth_step(moisture, 0.2, 0.46));
  ground.cover(colors.forest, GroundKind::grass, 0.45 * smooth_step(moisture, 0.5, 0.85));
  ground.cover(colors.dry, GroundKind::grass, 0.6 * smooth_step(-climate.temperature + patch, -1, 5));
  if (!world.has(Layer::plants)) return ground;
  const Wood wood = wood_at(world, sample, climate, at.x, at.y, spacing);
  // below crowns the floor of the wood, from afar the crowns themselves
  const double dark = spacing > widest_canopy_spacing ? 0.52 : 0.4;
  const Shade crowns{dark * wood.color[0], dark * wood.color[1], dark * wood.color[2]};
  ground.cover(spacing > widest_canopy_spacing ? crowns : mixed(crowns, colors.forest, 0.3), GroundKind::soil,
               0.95 * smooth_step(wood.cover, 0.06, 0.65));
  return ground;
}

/// Dry or lush, in hollows or on crests.
Shade tint_of(const Cover& ground, const Patches& patches, const GroundForm& form) {
  const double snow = ground.share(GroundKind::snow), strong = 1 - 0.75 * snow;
  const double light = (1 + 0.15 * strong * patches.broad) * (1 + 0.14 * strong * patches.fine) *
                       std::clamp(1 - hollow_share * form.hollow, 0.72, 1.25);
  const double dry = 0.15 * strong * patches.hue;
  return {light * (1 + dry), light * (1 + 0.25 * dry), light * (1 - 0.8 * dry)};
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

GroundLook ground_look(const World& world, const GroundColors& colors, const GroundSample& sample,
                       const glm::dvec2& at, const GroundForm& form) {
  const double spacing = form.spacing;
  const Climate climate = climate_at(world, at.x, at.y, sample.height);
  const Patches patches = patches_at(world, at.x, at.y, spacing);
  const double patch = patches.broad;
  Cover ground = cover_of(world, colors, sample, at, spacing, climate, patch);
  if (sample.field >= 0) {
    const Shade& crop = colors.fields[static_cast<std::size_t>(sample.field)];
    ground.cover(sample.is_hedge ? colors.forest : crop,
                 sample.is_hedge ? GroundKind::grass : GroundKind::soil, 0.85);
  }
  if (spacing <= widest_verge_spacing) {
    const double verge = 1 - smooth_step(sample.road + 0.4 * patch, 0.2, 3.5);
    ground.cover(colors.dry, GroundKind::soil, (sample.is_town ? 0.8 : 0.6) * verge);
  }
  const double bare = smooth_step(1 - form.steepness + 0.03 * patch + 0.025 * patches.fine, 0.09, 0.22);
  ground.cover(colors.rock, GroundKind::rock, bare);
  const bool has_sea = world.params.relief.sea;
  if (has_sea) {
    const double above = sample.height - world.params.relief.sea_level;
    ground.cover(colors.sand, GroundKind::sand, 1 - smooth_step(above + 0.8 * patch, 0.9, 3.2));
  }
  const double snow =
      smooth_step(-climate.temperature + 1.2 * patch + 0.8 * patches.fine - 3 * form.hollow, 3, 6) *
      (1 - smooth_step(1 - form.steepness, 0.25, 0.5));
  ground.cover(colors.snow, GroundKind::snow, snow);
  const GroundKind kind = ground.kind();
  ground.tint(tint_of(ground, patches, form));
  if (has_sea) {
    const double deep = 1.5 + 0.02 * spacing, below = world.params.relief.sea_level - sample.height;
    ground.cover(colors.water, GroundKind::sand, smooth_step(below, 0, deep));
  }
  const double by = form.is_textured ? 1 / ground_texture_mean : 1;
  const Shade& shade = ground.shade();
  return {{byte_of(by * shade.red), byte_of(by * shade.green), byte_of(by * shade.blue), 255}, kind};
}

std::array<std::uint8_t, 4> sea_color(const World& world, const GroundColors& colors, double depth,
                                      const glm::dvec2& at, double spacing) {
  constexpr double wind = 0.14;  // by which streaks of wind differ
  const double patch = patches_at(world, at.x, at.y, spacing).hue;
  const double pale = 0.36 - 0.22 * smooth_step(spacing, 128, 1024);  // bays seen from afar are dark
  const Shade shallow =
      mixed(colors.water, {colors.sand.red, 1.25 * colors.sand.green, 1.15 * colors.sand.blue}, pale);
  const Shade deep{0.55 * colors.water.red, 0.68 * colors.water.green, 0.8 * colors.water.blue};
  Shade shade =
      mixed(shallow, colors.water, smooth_step(depth + 0.6 * patch, -0.3, 6 + std::min(12.0, 0.1 * spacing)));
  shade = mixed(shade, deep, smooth_step(depth + 6 * patch, 8, 75));
  // the edge of the swell
  const double foam =
      0.5 * (1 - smooth_step(spacing, 8, 40)) * (1 - smooth_step(std::abs(depth - 0.15), 0.1, 0.6));
  shade = mixed(shade, {0.8, 0.83, 0.83}, foam);
  const double light = 1 + wind * patch;
  return {byte_of(light * shade.red), byte_of(light * shade.green), byte_of(light * shade.blue), 255};
}

}  // namespace seedmesh::world
