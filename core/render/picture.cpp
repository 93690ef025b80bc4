/// Deferred shading: the nearest surfaces are found first (samples.h), then each visible sample is lit once. Shadows
/// are a shadow map (Williams 1978) with percentage-closer filtering (Reeves and others 1987). The four samples of a
/// pixel look up different texels of one disc, so that their mean is soft.
#include "core/render/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/render/samples.h"
#include "core/texture/srgb.h"

namespace seedmesh::render {
namespace {

// Linear light, chosen so that a white wall in the sun is just below white.
constexpr glm::dvec3 sunlight{2.05, 1.93, 1.72}, skylight{0.46, 0.54, 0.66}, bounced{0.26, 0.25, 0.22};
constexpr glm::dvec3 sky_high{0.42, 0.58, 0.80}, sky_low{0.82, 0.87, 0.90};  // the background
constexpr glm::dvec3 ground_color{0.42, 0.43, 0.40};
constexpr double sun_turn = -55, sun_height = 48;  // degrees from the camera, and above the horizon
constexpr double ground_extent = 1.7;              // radius, as a multiple of that of the model
constexpr double shadow_offset = 1.5;              // texels, along the normal
constexpr std::uint32_t rows_of_chunk = 16;

/// Of a disc with a radius of 2.4 texels: two for each of the four samples of a pixel.
constexpr std::array<std::array<glm::dvec2, 2>, 4> taps = {{{{{0.6, 0.3}, {-1.9, 1.2}}},
                                                            {{{-0.4, -0.7}, {1.8, 1.5}}},
                                                            {{{1.1, -1.9}, {-1.2, -0.2}}},
                                                            {{{2.3, -0.3}, {-0.2, 2.0}}}}};

struct Stage {
  const Samples& samples;
  const Surfaces& surfaces;
  const ShadowMap& shadows;
  const Camera& camera;
  double ground;  ///< height of the plane
  bool has_ground;
  glm::dvec3 middle;
  double radius;  ///< of the visible ground
};

/// Which samples of a pixel look up their texels: [first, end).
struct Corners {
  std::uint32_t first = 0, end = 4;
};

double lit(const Stage& stage, const glm::dvec3& position, const Corners& corners) {
  double light = 0;
  for (std::uint32_t corner = corners.first; corner < corners.end; ++corner) {
    for (const glm::dvec2& tap : taps[corner]) light += stage.shadows.is_dark(position, tap) ? 0 : 0.5;
  }
  return light / (corners.end - corners.first);
}

/// The light that the sky and the ground send to a surface.
glm::dvec3 ambient(double up) { return glm::mix(bounced, skylight, 0.5 + 0.5 * up); }

/// The sky above the horizon, as glass and metal mirror it.
glm::dvec3 mirrored(double up) {
  return up < 0 ? bounced : glm::mix(sky_low, sky_high, std::min(1.0, 1.5 * up));
}

glm::dvec3 shade(const Stage& stage, const Sample& sample, const glm::dvec3& position,
                 const glm::dvec3& to_eye, std::uint32_t corner) {
  const Surface& surface = stage.surfaces[sample.surface];
  const glm::dvec3 color = glm::dvec3(glm::u16vec3(sample.color)) / 65'535.0;
  const glm::dvec3 emitted(surface.emissive);
  if (surface.unlit) return color + emitted;
  const glm::dvec3& sun = stage.shadows.frame.towards;
  if (glm::i8vec3(sample.normal) == glm::i8vec3(0)) return color * (0.6 * sunlight + skylight) + emitted;
  const glm::dvec3 normal = math::unit(glm::dvec3(glm::i8vec3(sample.normal)), glm::dvec3(0, 1, 0));
  const double facing = glm::dot(normal, sun);
  const double through = static_cast<double>(surface.transmission);
  const double direct = std::max(facing, 0.0) * (1 - 0.5 * through) + std::max(-facing, 0.0) * 0.5 * through;
  // A thin sheet takes its shadow on the side of the sun.
  const glm::dvec3 outside =
      position + normal * ((facing < 0 ? -1.0 : 1.0) * shadow_offset * stage.shadows.step);
  const double sunny = direct > 0 ? direct * lit(stage, outside, {corner, corner + 1}) : 0;
  glm::dvec3 light = color * (sunny * sunlight + ambient(normal.y));
  const double rough = static_cast<double>(surface.roughness), metal = static_cast<double>(surface.metallic);
  const double gloss = (1 - rough) * (1 - rough);
  if (gloss > 0.01) {
    const double across = std::clamp(1 - glm::dot(normal, to_eye), 0.0, 1.0);
    const double fresnel = across * across * across * across * across;
    const glm::dvec3 base = glm::mix(glm::dvec3(0.04), color, metal);
    const glm::dvec3 ray = 2.0 * glm::dot(normal, to_eye) * normal - to_eye;
    light = light * (1 - metal * gloss) + (base + (1.0 - base) * fresnel) * gloss * mirrored(ray.y);
  }
  return light + emitted;
}

glm::dvec3 backdrop(double y) {
  return glm::mix(sky_low, sky_high, std::clamp(0.5 + 0.5 * y, 0.0, 1.0) * 0.55);
}

/// The plane below the model, which fades into the background.
glm::dvec3 ground_at(const Stage& stage, const glm::dvec3& position, const glm::dvec3& behind,
                     const Corners& corners) {
  const glm::dvec2 from(position.x - stage.middle.x, position.z - stage.middle.z);
  const double distance = std::sqrt(glm::dot(from, from)) / stage.radius;
  if (distance >= 1) return behind;
  const double seen = 1 - distance * distance * (3 - 2 * distance);
  const double sun = stage.shadows.frame.towards.y * lit(stage, position, corners);
  const glm::dvec3 light = ground_color * (sun * sunlight + ambient(1) * 0.9);
  return glm::mix(behind, light, seen);
}

/// Straight up to 0.7, then ever flatter towards 1.
double compressed(double light) {
  constexpr double knee = 0.7, rest = 1 - knee;
  return light <= knee ? light : knee + rest * (1 - rest / (light - knee + rest));
}

/// A line of sight through a point of the image, in samples. At distance 1 along the axis of the camera.
struct Sight {
  glm::dvec3 ray;
  double height;  ///< in the image, -1 to 1
  double ground;  ///< distance of the ground along the ray; 0: none
};

Sight sight_of(const Stage& stage, double x, double y) {
  const double half = 0.5 * stage.samples.size;
  const Frame& frame = stage.camera.frame;
  Sight sight;
  sight.height = (half - y) / half;
  sight.ray =
      (frame.right * ((x - half) / half) + frame.up * sight.height) * stage.camera.half - frame.towards;
  const double down = sight.ray.y < 0 ? (stage.ground - stage.camera.eye.y) / sight.ray.y : 0;
  sight.ground = stage.has_ground ? std::max(down, 0.0) : 0;
  return sight;
}

/// What is seen where nothing of the model is.
glm::dvec3 behind(const Stage& stage, const Sight& sight, std::uint32_t first_tap, std::uint32_t taps_end) {
  const glm::dvec3 sky = backdrop(sight.height);
  if (sight.ground == 0) return sky;
  return ground_at(stage, stage.camera.eye + sight.ray * sight.ground, sky, {first_tap, taps_end});
}

glm::dvec3 color_at(const Stage& stage, std::uint32_t x, std::uint32_t y, const Sample& sample) {
  const std::uint32_t corner = x % 2 + 2 * (y % 2);
  const Sight sight = sight_of(stage, x + 0.5, y + 0.5);
  const double distance = sample.near > 0 ? 1 / static_cast<double>(sample.near) : 0;
  const bool is_below = sight.ground > 0 && distance > sight.ground * 1.0001;
  if (distance == 0 || is_below) return behind(stage, sight, corner, corner + 1);
  const glm::dvec3 position = stage.camera.eye + sight.ray * distance;
  return shade(stage, sample, position, math::unit(-sight.ray, stage.camera.frame.towards), corner);
}

glm::u8vec3 pixel_at(const Stage& stage, std::uint32_t x, std::uint32_t y) {
  std::array<const Sample*, 4> samples;
  bool is_empty = true;
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::size_t row = 2 * y + corner / 2;
    samples[corner] = &stage.samples.of[row * stage.samples.size + 2 * x + corner % 2];
    is_empty = is_empty && samples[corner]->near == 0;
  }
  glm::dvec3 sum(0);
  const auto add = [&](const glm::dvec3& color, double times) {
    for (int c = 0; c < 3; ++c) sum[c] += times * compressed(color[c]);
  };
  if (is_empty) {
    add(behind(stage, sight_of(stage, 2 * x + 1, 2 * y + 1), 0, 4), 4);
  } else {
    for (std::uint32_t corner = 0; corner < 4; ++corner)
      add(color_at(stage, 2 * x + corner % 2, 2 * y + corner / 2, *samples[corner]), 1);
  }
  glm::u8vec3 pixel;
  for (int c = 0; c < 3; ++c) pixel[c] = texture::srgb_of(math::to_uint32(sum[c] * (65'535.0 / 4) + 0.5));
  return pixel;
}

/// Plants and buildings stand at height 0, with roots and foundations below; other models on their lowest point.
double ground_of(const Box& box) {
  constexpr double deepest = 0.25;  // share of the height that may be below
  const double low = static_cast<double>(box.min.y), high = static_cast<double>(box.max.y);
  return low < 0 && -low < deepest * (high - low) ? 0 : low;
}

}  // namespace

texture::Picture draw_picture(const Model& model, const PictureOptions& options, const Job& job) {
  const Items items = items_of(model, job);
  const Surfaces surfaces(model, job);
  const Camera camera = camera_for(model, items, options.view);
  const std::uint32_t side = 2 * options.size;
  const Samples samples = draw_samples(model, items, surfaces, camera, side, job);
  const View sun{options.view.azimuth + sun_turn, sun_height};
  const ShadowMap shadows = draw_shadows(model, items, surfaces, sun, side, job);
  const glm::dvec3 size(items.box.max - items.box.min);
  const Stage stage{samples,
                    surfaces,
                    shadows,
                    camera,
                    ground_of(items.box),
                    options.ground && !items.list.empty(),
                    glm::dvec3(0.5F * (items.box.min + items.box.max)),
                    ground_extent * std::max(0.5 * std::sqrt(glm::dot(size, size)), 1e-6)};
  texture::Picture picture;
  picture.width = picture.height = options.size;
  picture.channels = 3;
  picture.bytes = Array<std::uint8_t>(job, std::size_t{3} * options.size * options.size);
  parallel_for(job, options.size, rows_of_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t y = begin; y < end; ++y) {
      for (std::uint32_t x = 0; x < options.size; ++x) {
        const glm::u8vec3 pixel = pixel_at(stage, x, static_cast<std::uint32_t>(y));
        for (int c = 0; c < 3; ++c)
          picture.bytes[3 * (y * options.size + x) + static_cast<std::size_t>(c)] = pixel[c];
      }
    }
  });
  return picture;
}

}  // namespace seedmesh::render
