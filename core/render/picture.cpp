/// Deferred shading: the nearest surfaces are found first (samples.h). Then each triangle that a pixel shows is lit once,
/// at the middle of its samples. The four samples of a pixel read different texels of one disc of the shadow map, so
/// that their mean is soft.
#include "core/render/picture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/render/samples.h"
#include "core/render/shadow.h"
#include "core/texture/srgb.h"

namespace seedmesh::render {
namespace {

// Linear light, chosen so that a white wall in the sun is just below white.
constexpr glm::vec3 sunlight{2.05F, 1.93F, 1.72F}, skylight{0.46F, 0.54F, 0.66F},
    bounced{0.26F, 0.25F, 0.22F};
constexpr glm::vec3 sky_high{0.42F, 0.58F, 0.80F}, sky_low{0.82F, 0.87F, 0.90F};  // the background
constexpr glm::vec3 ground_color{0.42F, 0.43F, 0.40F};
constexpr double sun_turn = -55, sun_height = 48;  // degrees from the camera, and above the horizon
constexpr double ground_extent = 1.7;              // radius, as a multiple of that of the model
constexpr float shadow_offset = 1;                 // texels, along the normal
constexpr std::uint32_t rows_of_chunk = 16;

/// Of a disc with a radius of 1.5 texels: two for each of the four samples of a pixel.
constexpr std::array<std::array<glm::vec2, 2>, 4> taps = {{{{{0.4F, 0.2F}, {-1.2F, 0.7F}}},
                                                           {{{-0.3F, -0.4F}, {1.1F, 0.9F}}},
                                                           {{{0.7F, -1.2F}, {-0.8F, -0.1F}}},
                                                           {{{1.4F, -0.2F}, {-0.1F, 1.3F}}}}};

struct Stage {
  const Samples& samples;
  const ProjectedScene& shown;
  const ShadowMap& shadows;
  glm::vec3 eye, right, up,
      towards;  ///< of the camera; the first two reach from the middle of the image to its sides
  glm::vec3 sun;
  float texel;   ///< of the shadow map, in metres
  float ground;  ///< height of the plane
  bool has_ground;
  glm::vec3 middle;
  float radius;  ///< of the visible ground
};

/// Some of the four samples of a pixel, one bit each, and the position of their middle in samples.
struct Group {
  std::uint32_t corners = 0;
  float x = 0, y = 0;
  float share = 0;  ///< a quarter for each
};

/// The share of sunlight that reaches a position.
float lit(const Stage& stage, const glm::vec3& position, std::uint32_t corners) {
  const ShadowMap::Position at = stage.shadows.position_of(position);
  const float common = stage.shadows.common_light(at);
  if (common >= 0) return common;
  std::uint32_t light = 0, count = 0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    if ((corners >> corner & 1U) == 0) continue;
    for (const glm::vec2& tap : taps[corner]) light += stage.shadows.is_dark(at, tap.x, tap.y) ? 0 : 1;
    count += 2;
  }
  return static_cast<float>(light) / static_cast<float>(count);
}

/// The light that the sky and the ground send to a surface.
glm::vec3 ambient(float up) { return glm::mix(bounced, skylight, 0.5F + 0.5F * up); }

/// The sky above the horizon, as glass and metal mirror it.
glm::vec3 mirrored(float up) {
  return up < 0 ? bounced : glm::mix(sky_low, sky_high, std::min(1.0F, 1.5F * up));
}

glm::vec3 shade(const Stage& stage, const Fragment& fragment, const glm::vec3& position, const glm::vec3& ray,
                std::uint32_t corners) {
  const Surface& surface = stage.shown.scene.surfaces[fragment.surface];
  if (surface.unlit) return fragment.color + surface.emissive;
  if (fragment.normal == glm::vec3(0))
    return fragment.color * (0.6F * sunlight + skylight) + surface.emissive;
  const glm::vec3& normal = fragment.normal;
  const float facing = glm::dot(normal, stage.sun), through = surface.transmission;
  const float direct =
      std::max(facing, 0.0F) * (1 - 0.5F * through) + std::max(-facing, 0.0F) * 0.5F * through;
  // A thin sheet takes its shadow on the side of the sun.
  const glm::vec3 outside = position + normal * ((facing < 0 ? -shadow_offset : shadow_offset) * stage.texel);
  const float sunny = direct > 0 ? direct * lit(stage, outside, corners) : 0;
  glm::vec3 light = fragment.color * (sunny * sunlight + ambient(normal.y));
  const float gloss = (1 - surface.roughness) * (1 - surface.roughness);
  if (gloss > 0.01F) {
    const glm::vec3 to_eye = math::quick_unit(-ray, stage.towards);
    const float across = std::clamp(1 - glm::dot(normal, to_eye), 0.0F, 1.0F);
    const float fresnel = across * across * across * across * across;
    const glm::vec3 base = glm::mix(glm::vec3(0.04F), fragment.color, surface.metallic);
    const glm::vec3 back = 2.0F * glm::dot(normal, to_eye) * normal - to_eye;
    light =
        light * (1 - surface.metallic * gloss) + (base + (1.0F - base) * fresnel) * gloss * mirrored(back.y);
  }
  return light + surface.emissive;
}

glm::vec3 backdrop(float height) {
  return glm::mix(sky_low, sky_high, std::clamp(0.5F + 0.5F * height, 0.0F, 1.0F) * 0.55F);
}

/// The plane below the model, which fades into the background.
glm::vec3 ground_at(const Stage& stage, const glm::vec3& position, const glm::vec3& behind,
                    std::uint32_t corners) {
  const glm::vec2 from(position.x - stage.middle.x, position.z - stage.middle.z);
  const float square = glm::dot(from, from);
  if (square >= stage.radius * stage.radius) return behind;
  const float distance = std::sqrt(square) / stage.radius;
  const float seen = 1 - distance * distance * (3 - 2 * distance);
  const float sun = stage.sun.y * lit(stage, position, corners);
  const glm::vec3 light = ground_color * (sun * sunlight + ambient(1) * 0.9F);
  return glm::mix(behind, light, seen);
}

/// Straight up to 0.7, then ever flatter towards 1.
glm::vec3 compressed(const glm::vec3& light) {
  constexpr float knee = 0.7F, rest = 1 - knee;
  glm::vec3 out = light;
  for (int c = 0; c < 3; ++c) {
    if (light[c] > knee) out[c] = knee + rest * (1 - rest / (light[c] - knee + rest));
  }
  return out;
}

/// A line of sight through a point of the image, in samples. At distance 1 along the axis of the camera.
struct Sight {
  glm::vec3 ray;
  float height;  ///< in the image, -1 to 1
  float ground;  ///< distance of the ground along the ray; 0: none
};

Sight sight_of(const Stage& stage, float x, float y) {
  const float half = 0.5F * static_cast<float>(stage.samples.size), per_half = 1 / half;
  Sight sight;
  sight.height = (half - y) * per_half;
  sight.ray = (stage.right * ((x - half) * per_half) + stage.up * sight.height) - stage.towards;
  const float down = sight.ray.y < 0 ? (stage.ground - stage.eye.y) / sight.ray.y : 0;
  sight.ground = stage.has_ground ? std::max(down, 0.0F) : 0;
  return sight;
}

/// What is seen where nothing of the model is.
glm::vec3 behind(const Stage& stage, const Sight& sight, std::uint32_t corners) {
  const glm::vec3 sky = backdrop(sight.height);
  if (sight.ground == 0) return sky;
  return ground_at(stage, stage.eye + sight.ray * sight.ground, sky, corners);
}

glm::vec3 color_at(const Stage& stage, const Fragment& fragment, const Group& group) {
  const Sight sight = sight_of(stage, group.x, group.y);
  const float distance = 1 / fragment.near;
  if (sight.ground > 0 && distance > sight.ground * 1.0001F) return behind(stage, sight, group.corners);
  return shade(stage, fragment, stage.eye + sight.ray * distance, sight.ray, group.corners);
}

/// The pixels of some rows.
class Painter {
 public:
  explicit Painter(const Stage& stage) : stage_(stage), reader_(stage.shown) {}

  glm::u8vec3 pixel_at(std::uint32_t x, std::uint32_t y) {
    const Samples& samples = stage_.samples;
    const std::size_t first = samples.at(2 * x, 2 * y), below = first + samples.stride;
    const std::array<std::size_t, 4> at = {first, first + 1, below, below + 1};
    const Group whole{15, static_cast<float>(2 * x + 1), static_cast<float>(2 * y + 1), 1};
    if (is_same(at[0], at[1]) && is_same(at[0], at[2]) && is_same(at[0], at[3]))
      return pixel_of(compressed(color_of(at[0], whole)));
    glm::vec3 sum(0);
    for (std::uint32_t rest = 15; rest != 0;) {
      const auto leader = static_cast<std::size_t>(std::countr_zero(rest));
      const Group group = group_of(at, leader, whole);
      rest &= ~group.corners;
      sum += group.share * compressed(color_of(at[leader], group));
    }
    return pixel_of(sum);
  }

 private:
  /// The samples from `leader` on that show the same as it.
  Group group_of(const std::array<std::size_t, 4>& at, std::size_t leader, const Group& whole) const {
    Group group;
    for (std::uint32_t corner = static_cast<std::uint32_t>(leader); corner < 4; ++corner) {
      if (corner != leader && !is_same(at[leader], at[corner])) continue;
      group.corners |= 1U << corner;
      group.share += 0.25F;
      group.x += static_cast<float>(corner % 2);
      group.y += static_cast<float>(corner >> 1U);
    }
    const float each = 0.25F / group.share;
    group.x = whole.x - 0.5F + group.x * each;
    group.y = whole.y - 0.5F + group.y * each;
    return group;
  }

  glm::u8vec3 pixel_of(const glm::vec3& color) const {
    glm::u8vec3 pixel;
    for (int c = 0; c < 3; ++c) {
      const float whole = std::clamp(color[c], 0.0F, 1.0F) * 65'535.0F + 0.5F;
      pixel[c] = srgb_[static_cast<std::size_t>(static_cast<std::int32_t>(whole)) / 16];
    }
    return pixel;
  }

  /// Whether two samples show one triangle, or nothing.
  bool is_same(std::size_t a, std::size_t b) const {
    const Samples& samples = stage_.samples;
    return samples.drawing[a] == samples.drawing[b] && samples.number[a] == samples.number[b] &&
           samples.drawing[a] != Samples::blended;
  }

  glm::vec3 color_of(std::size_t at, const Group& group) {
    const Samples& samples = stage_.samples;
    if (samples.drawing[at] == Samples::nothing)
      return behind(stage_, sight_of(stage_, group.x, group.y), group.corners);
    if (samples.drawing[at] == Samples::blended) return color_at(stage_, samples.fragment[at], group);
    return color_at(stage_,
                    reader_.at(samples.drawing[at], samples.number[at], group.x * fixed_one,
                               group.y * fixed_one, 4 * group.share),
                    group);
  }

  const Stage& stage_;
  FragmentReader reader_;
  const std::array<std::uint8_t, 4096>& srgb_ = texture::srgb_table();
};

/// Plants and buildings stand at height 0, with roots and foundations below; other models on their lowest point.
float ground_of(const Box& box) {
  constexpr float deepest = 0.125F;  // share of the height that may be below
  return box.min.y < 0 && -box.min.y < deepest * (box.max.y - box.min.y) ? 0 : box.min.y;
}

/// The middle of the square image.
texture::Picture painted(const Stage& stage, const PictureOptions& options, const Job& job) {
  texture::Picture picture;
  picture.width = options.width;
  picture.height = options.height;
  picture.channels = 3;
  picture.bytes = Array<std::uint8_t>(job, std::size_t{3} * options.width * options.height);
  const std::uint32_t side = std::max(options.width, options.height), left = (side - options.width) / 2,
                      top = (side - options.height) / 2;
  parallel_for(job, options.height, rows_of_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    Painter painter(stage);
    std::uint8_t* out = picture.bytes.data() + 3 * begin * options.width;
    for (std::size_t y = begin; y < end; ++y) {
      for (std::uint32_t x = 0; x < options.width; ++x) {
        const glm::u8vec3 pixel = painter.pixel_at(left + x, top + static_cast<std::uint32_t>(y));
        for (int c = 0; c < 3; ++c) *out++ = pixel[c];
      }
    }
  });
  return picture;
}

}  // namespace

texture::Picture draw_picture(const Model& model, const PictureOptions& options, const Job& job) {
  const Items items = items_of(model, job);
  const Surfaces surfaces(model, job);
  const Scene scene = scene_of(model, items, surfaces, job);
  const std::uint32_t side = std::max(options.width, options.height);
  const double azimuth = options.view.azimuth;
  const Camera camera = camera_for(model, items, frame_of(azimuth, elevation_of(options.view, items.box)),
                                   glm::dvec2(options.width, options.height) / static_cast<double>(side));
  const ProjectedScene shown = project(scene, Eye(camera, 2 * side), job);
  const Samples samples = draw_samples(shown, job);
  const ShadowMap shadows = draw_shadows(scene, frame_of(azimuth + sun_turn, sun_height), side, job);
  const glm::dvec3 size(items.box.max - items.box.min);
  const Stage stage{
      samples,
      shown,
      shadows,
      glm::vec3(camera.eye),
      glm::vec3(camera.frame.right * camera.half),
      glm::vec3(camera.frame.up * camera.half),
      glm::vec3(camera.frame.towards),
      glm::vec3(shadows.frame.towards),
      static_cast<float>(shadows.step),
      ground_of(items.box),
      options.ground && !items.list.empty(),
      0.5F * (items.box.min + items.box.max),
      static_cast<float>(ground_extent * std::max(0.5 * std::sqrt(glm::dot(size, size)), 1e-6))};
  return painted(stage, options, job);
}

}  // namespace seedmesh::render
