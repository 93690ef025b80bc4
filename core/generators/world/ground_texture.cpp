/// Grounds seen from above: the details of terrains (core/texture/ground.h), with blotches of several sizes.
#include "core/generators/world/ground_texture.h"

#include <algorithm>
#include <vector>

#include "core/base/math.h"
#include "core/texture/ground.h"
#include "core/texture/noise.h"
#include "core/texture/srgb.h"

namespace seedmesh::world {
namespace {

/// Texels along a side. Wide tiles are many, and clients that copy images for each tile keep all of them in memory.
constexpr int texels_of(GroundKind kind) { return kind == GroundKind::land ? 256 : 512; }
constexpr std::uint64_t key = 0x47524F554E44U;
constexpr int lights = 26, hues = 5;  ///< colours of the palette; few keep the file small

/// How the detail of a kind becomes a texture. Amplitudes are shares of the mean.
struct Look {
  texture::Relief (*detail)(int size, Rng rng, const Job& job);
  double tone = 1, height = 0;  ///< factors of the tone and of the height, which is dark in hollows
  double blotches = 0;          ///< amplitude of blotches from a third to a 25th of the image
  double warmth = 0;            ///< greatest share by which red rises and blue falls
};

Look look_of(GroundKind kind) {
  switch (kind) {
    case GroundKind::grass:
      return {&texture::grass_ground, 1.4, 0.65, 0.4, 0.075};
    case GroundKind::soil:
      return {&texture::soil_ground, 1.1, 0.8, 0.36, 0.08};
    case GroundKind::rock:
      return {&texture::rock_ground, 1.1, 0.5, 0.34, 0.06};
    case GroundKind::sand:
      return {&texture::sand_ground, 0.7, 0.35, 0.3, 0.05};
    case GroundKind::snow:
      return {&texture::snow_ground, 0.16, 0.1, 0.1, 0.015};
    case GroundKind::land:
      return {&texture::scree_ground, 0.4, 0.35, 0.5, 0.09};
  }
  return {};
}

/// Light of all texels, with this mean.
std::vector<double> light_of(const texture::Relief& relief, const Look& look, double mean, Rng rng,
                             const Job& job) {
  const int texels = relief.tone.size();
  const texture::Noise blotches(texels, {3, 4}, {4, 0.8F}, 1, rng.at("blotches"));
  texture::NoiseRows rows(blotches);
  std::vector<double> light;
  light.reserve(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels));
  double sum = 0;
  for (int y = 0; y < texels; ++y) {
    job.check();
    const float* blotch = rows.row(y);
    for (int x = 0; x < texels; ++x) {
      const double tone = static_cast<double>(relief.tone.at(x, y)) - 0.5,
                   high = static_cast<double>(relief.height.at(x, y)) - 0.5;
      const double own =
          (1 + look.tone * tone + look.height * high) * (1 + look.blotches * static_cast<double>(blotch[x]));
      light.push_back(std::max(own, 0.08));
      sum += light.back();
    }
  }
  const double by = mean * static_cast<double>(light.size()) / sum;
  for (double& each : light) each = std::min(1.0, by * each);
  return light;
}

std::uint8_t srgb_byte(double linear) {
  return texture::srgb_of(
      static_cast<std::uint32_t>(math::to_int32(std::clamp(linear, 0.0, 1.0) * 65535 + 0.5)));
}

/// The colour of a palette: a light from dark to white in even steps of sRGB, cool, neutral or warm.
glm::u8vec3 color_of(int light, int hue, double warmth) {
  const auto grey = static_cast<std::uint8_t>(255 * (light + 1) / lights);
  const double linear = static_cast<double>(linear_of_srgb(grey)), warm = warmth * (hue - 2) / 2;
  return {srgb_byte(linear * (1 + warm)), srgb_byte(linear), srgb_byte(linear * (1 - 1.2 * warm))};
}

SharedImage image_of(GroundKind kind, const Job& job) {
  const Look look = look_of(kind);
  const Rng rng = Rng(key).at(static_cast<std::uint64_t>(kind));
  const int texels = texels_of(kind);
  const texture::Relief relief = look.detail(texels, rng.at("detail"), job);
  const std::vector<double> light = light_of(relief, look, mean_of(kind), rng, job);
  const texture::Noise warmth(texels, {5, 5}, {3, 0.8F}, 1, rng.at("warmth"));
  texture::NoiseRows rows(warmth);
  std::vector<glm::u8vec3> palette;
  for (int hue = 0; hue < hues; ++hue) {
    for (int step = 0; step < lights; ++step) palette.push_back(color_of(step, hue, look.warmth));
  }
  std::vector<std::byte> numbers;
  numbers.reserve(light.size());
  for (int y = 0; y < texels; ++y) {
    const float* warm = rows.row(y);
    for (int x = 0; x < texels; ++x) {
      const double value = light[static_cast<std::size_t>(y * texels + x)];
      const int step = std::clamp(math::to_int32(srgb_byte(value) * lights / 255.0 + 0.5) - 1, 0, lights - 1);
      // light texels are warm, dark ones cool
      const double warmer = static_cast<double>(warm[x]) + 0.8 * (value / mean_of(kind) - 1);
      const int hue = std::clamp(math::to_int32(std::floor(2.5 + 5 * warmer)), 0, hues - 1);
      numbers.push_back(static_cast<std::byte>(hue * lights + step));
    }
  }
  const auto side = static_cast<std::uint32_t>(texels);
  return shared_image({side, side, 1, 8, numbers, palette}, job);
}

}  // namespace

std::shared_ptr<const SharedImage> ground_texture(const World& world, GroundKind kind, const Job& job) {
  return world.store->get<SharedImage>(
      {0, Store::Layer::file, -1, 1, static_cast<std::int64_t>(kind)}, job,
      [&] { return std::make_shared<const SharedImage>(image_of(kind, job)); });
}

}  // namespace seedmesh::world
