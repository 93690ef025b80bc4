#include "core/generators/terrain/colors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/smooth_step.h"
#include "core/model/model.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Fresh snow reflects at most nine tenths of the light (Wiscombe and Warren, 1980).
constexpr float brightest = 0.9F;

struct Srgb {
  std::uint8_t r, g, b;
};

/// Colours, and the heights and slopes at which they begin. Heights are shares of the range above water.
struct Ramp {
  Srgb bed, shore, low, high, cliff, peak;
  float high_line, peak_line;  ///< above 1: none
  float cliff_from, cliff_to;  ///< rise over run
};

// In the order of PaletteName; `grey` and `none` have no ramp.
constexpr std::array<Ramp, 9> ramps{{
    {{70, 84, 84},
     {178, 166, 132},
     {90, 103, 60},
     {116, 116, 80},
     {112, 106, 100},
     {240, 243, 248},
     0.42F,
     0.72F,
     0.55F,
     1.0F},
    {{120, 104, 84},
     {209, 187, 159},
     {201, 173, 143},
     {180, 143, 122},
     {150, 112, 99},
     {202, 166, 144},
     0.45F,
     0.85F,
     0.5F,
     0.9F},
    {{52, 110, 112},
     {232, 216, 172},
     {88, 110, 68},
     {66, 86, 54},
     {104, 96, 86},
     {128, 122, 110},
     0.35F,
     0.92F,
     0.75F,
     1.25F},
    {{92, 116, 132},
     {186, 196, 204},
     {206, 214, 222},
     {232, 238, 244},
     {96, 102, 112},
     {250, 252, 255},
     0.3F,
     0.55F,
     0.6F,
     1.0F},
    {{52, 50, 52},
     {84, 78, 74},
     {70, 66, 62},
     {52, 48, 48},
     {38, 35, 36},
     {128, 62, 44},
     0.4F,
     0.93F,
     0.7F,
     1.2F},
    {{84, 83, 82},
     {110, 108, 106},
     {122, 120, 118},
     {150, 148, 145},
     {98, 96, 95},
     {172, 170, 167},
     0.5F,
     0.85F,
     0.45F,
     0.9F},
    {{104, 100, 94},
     {132, 126, 116},
     {146, 141, 130},
     {138, 134, 126},
     {122, 117, 109},
     {150, 146, 138},
     0.6F,
     1.6F,
     0.5F,
     1.5F},
    {{70, 68, 60},
     {96, 92, 80},
     {84, 93, 48},
     {98, 102, 60},
     {112, 108, 100},
     {120, 118, 108},
     0.8F,
     1.6F,
     0.45F,
     1.15F},
    {{70, 72, 62},
     {128, 116, 92},
     {84, 96, 52},
     {100, 98, 66},
     {112, 108, 100},
     {120, 118, 108},
     0.8F,
     1.6F,
     0.5F,
     1.05F},
}};

/// Fallen leaves and needles.
constexpr Srgb litter_color{106, 91, 70};

glm::vec3 linear(const Srgb& color) {
  return {linear_of_srgb(color.r), linear_of_srgb(color.g), linear_of_srgb(color.b)};
}

glm::vec3 blend(const glm::vec3& a, const glm::vec3& b, float share) { return a + (b - a) * share; }

}  // namespace

float litter_share(const Site& site) { return smooth_step(-0.3F, 0.2F, site.patch); }

GroundColors::GroundColors(PaletteName palette, const Range& range, float level)
    : palette_(palette), range_(range), level_(level) {
  water_ = level > range.low;
  const float ground = water_ ? std::min(level, range.high) : range.low;
  span_ = std::max(range.high - ground, 1e-6F);
  const Ramp& ramp = ramps[std::min(static_cast<std::size_t>(palette_), ramps.size() - 1)];
  linear_ = {linear(ramp.bed),  linear(ramp.shore), linear(ramp.low),
             linear(ramp.high), linear(ramp.cliff), linear(ramp.peak)};
}

GroundColors::Shares GroundColors::shares(const Site& site) const {
  const Ramp& ramp = ramps[std::min(static_cast<std::size_t>(palette_), ramps.size() - 1)];
  const float share = (site.height - (range_.high - span_)) / span_ + site.patch * 0.045F;
  Shares all{};
  all.high = smooth_step(ramp.high_line - 0.22F, ramp.high_line + 0.22F, share);
  all.cliff = smooth_step(ramp.cliff_from, ramp.cliff_to, site.slope + site.patch * 0.08F);
  // There is snow in hollows and none on cliffs.
  all.peak = smooth_step(ramp.peak_line - 0.08F, ramp.peak_line + 0.08F, share + site.hollow * 0.15F) *
             (1 - 0.85F * all.cliff);
  if (water_) {
    const float above = (site.height - level_) / span_ + site.patch * 0.008F;
    all.shore = (1 - smooth_step(0.012F, 0.035F, above)) * (1 - 0.7F * all.cliff);
    all.bed = 1 - smooth_step(-0.06F, 0.0F, above);
  }
  return all;
}

Cover GroundColors::cover(const Site& site) const {
  const Shares all = shares(site);
  Cover cover{.rock = 0, .grass = 1, .sand = 0, .snow = 0};
  const auto lay = [&cover](float share, float Cover::*kind) {
    for (float Cover::*each : {&Cover::rock, &Cover::grass, &Cover::sand, &Cover::snow})
      cover.*each *= 1 - share;
    cover.*kind += share;
  };
  lay(0.35F * all.high, &Cover::rock);
  lay(all.cliff, &Cover::rock);
  lay(all.peak, &Cover::snow);
  lay(std::max(all.shore, all.bed), &Cover::sand);
  return cover;
}

glm::vec3 GroundColors::color(const Site& site) const {
  if (palette_ == PaletteName::none) return glm::vec3(1);
  if (palette_ == PaletteName::grey) {
    const float share = (site.height - range_.low) / std::max(range_.high - range_.low, 1e-6F);
    return glm::vec3(0.05F + 0.85F * std::clamp(share, 0.0F, 1.0F));
  }
  const Shares all = shares(site);
  glm::vec3 color = linear_.low;
  if (palette_ == PaletteName::forest) color = blend(color, linear(litter_color), litter_share(site));
  color = blend(color, linear_.high, all.high);
  color = blend(color, linear_.cliff, all.cliff);
  color = blend(color, linear_.peak, all.peak);
  color = blend(color, linear_.shore, all.shore);
  color = blend(color, linear_.bed, all.bed);
  // Hollows are darker, ridges brighter, and patches vary.
  const float light = std::clamp(1 - site.hollow * 0.9F, 0.55F, 1.25F) * (1 + site.patch * 0.08F);
  return glm::clamp(color * light, glm::vec3(0), glm::vec3(brightest));
}

Sites::Sites(const Field& field, const Window& world, Rng rng, const Job& job)
    : field_(field), reach_(std::max(1, field.width / 96)), per_cell_(static_cast<float>(1 / field.cell)) {
  NoisePlan plan;
  plan.octaves = 4;
  plan.gain = 0.7;
  plan.amplitude = 0.7;
  plan.wavelength = std::max(8.0, field.width / 10.0) * field.cell;
  patches_ = noisy(plan, {world.x, world.z, field.width, field.depth}, field.cell, rng.at("patches"), job);
}

glm::vec2 Sites::gradient(std::int32_t x, std::int32_t z) const {
  const std::int32_t m = field_.margin;
  const std::int32_t west = std::max(x - 1, -m), east = std::min(x + 1, field_.width - 1 + m);
  const std::int32_t north = std::max(z - 1, -m), south = std::min(z + 1, field_.depth - 1 + m);
  return {(field_.at(east, z) - field_.at(west, z)) * per_cell_ / static_cast<float>(east - west),
          (field_.at(x, south) - field_.at(x, north)) * per_cell_ / static_cast<float>(south - north)};
}

Site Sites::at(std::int32_t x, std::int32_t z) const {
  const glm::vec2 slope = gradient(x, z);
  const std::int32_t west = std::max(x - reach_, 0), east = std::min(x + reach_, field_.width - 1);
  const std::int32_t north = std::max(z - reach_, 0), south = std::min(z + reach_, field_.depth - 1);
  const float here = field_.at(x, z);
  const float around =
      ((field_.at(west, z) + field_.at(east, z)) + (field_.at(x, north) + field_.at(x, south))) * 0.25F;
  Site site;
  site.height = here;
  site.slope = std::sqrt(slope.x * slope.x + slope.y * slope.y);
  site.hollow = (around - here) * per_cell_ / static_cast<float>(reach_);
  site.patch = patches_.at(x, z);
  return site;
}

glm::u8vec4 vertex_color(const Sites& sites, const GroundColors& ground_colors, std::int32_t x,
                         std::int32_t z) {
  // Colours lie between 0 and 1.
  const glm::vec3 color = ground_colors.color(sites.at(x, z)) * 255.0F + 0.5F;
  const auto byte_of = [](float value) {
    return static_cast<std::uint8_t>(static_cast<std::int32_t>(value));
  };
  return {byte_of(color.x), byte_of(color.y), byte_of(color.z), 255};
}

Array<glm::u8vec4> vertex_colors(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                                 const Job& job) {
  Array<glm::u8vec4> colors(job,
                            static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth));
  parallel_for(job, static_cast<std::size_t>(field.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (std::size_t z = begin; z < end; ++z) {
                   glm::u8vec4* row = colors.data() + z * static_cast<std::size_t>(field.width);
                   for (std::int32_t x = 0; x < field.width; ++x)
                     row[x] = vertex_color(sites, ground_colors, x, static_cast<std::int32_t>(z));
                 }
               });
  return colors;
}

glm::u8vec3 srgb_of(const glm::vec3& linear_color) {
  constexpr std::size_t steps = 4096;
  static const auto table = [] {
    std::array<std::uint8_t, steps + 1> all{};
    for (std::size_t i = 0; i <= steps; ++i) {
      const double value = static_cast<double>(i) / steps;
      const double encoded = value <= 0.0031308 ? value * 12.92 : 1.055 * math::pow(value, 1 / 2.4) - 0.055;
      all[i] = static_cast<std::uint8_t>(math::to_int32(encoded * 255 + 0.5));
    }
    return all;
  }();
  const auto encode = [&](float value) {
    return table[static_cast<std::size_t>(
        math::to_int32(static_cast<double>(std::clamp(value, 0.0F, 1.0F)) * steps + 0.5))];
  };
  return {encode(linear_color.x), encode(linear_color.y), encode(linear_color.z)};
}

}  // namespace seedmesh::terrain
