#include "core/generators/scene/rules.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/texture/data_uri.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr int octaves = 3;
// Standard deviation of the three octaves, so that patches cover about the requested share of the ground.
constexpr double noise_deviation = 0.27;

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Gradient noise with one of eight directions at each corner of a square.
double gradient_noise(const glm::dvec2& p, std::uint64_t key) {
  const double left = std::floor(p.x), top = std::floor(p.y);
  const double u = p.x - left, v = p.y - top;
  const auto x = static_cast<std::uint64_t>(math::to_int64(left));
  const auto z = static_cast<std::uint64_t>(math::to_int64(top));
  const auto corner = [&](std::uint64_t i, std::uint64_t j) {
    const std::uint64_t bits = key_at(key, (x + i) << 32U ^ ((z + j) & 0xFFFFFFFFU));
    const double dx = u - static_cast<double>(i), dz = v - static_cast<double>(j);
    const double a = (bits & 1U) != 0 ? dx : -dx, b = (bits & 2U) != 0 ? dz : -dz;
    constexpr double diagonal = 0.70710678118654752;
    switch (bits >> 2U & 3U) {
      case 0:
        return a;
      case 1:
        return b;
      default:
        return (a + b) * diagonal;
    }
  };
  const double s = fade(u), t = fade(v);
  const double north = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * s;
  const double south = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * s;
  return north + (south - north) * t;
}

/// Returns the quantile of a normal distribution in standard deviations, by the logistic approximation, which
/// is accurate enough for patches.
double deviations_of(double share) {
  if (share <= 0) return -6;
  if (share >= 1) return 6;
  return std::clamp(math::log(share / (1 - share)) / 1.702, -6.0, 6.0);
}

double share_of_noise(const SceneNoise& noise, const glm::dvec2& p, std::uint64_t key) {
  const double value = patch_noise(p / noise.wavelength, key) / noise_deviation;
  const double above = value + deviations_of(noise.share);
  if (noise.soft <= 0) return above >= 0 ? 1 : 0;
  return std::clamp(0.5 + above / (2 * noise.soft), 0.0, 1.0);
}

DensityImage read_image(const std::string& text, const std::string& pointer, const Job& job) {
  Result<texture::Brightness> image = texture::brightness_of_png(text, job);
  if (!image) job.refuse({IssueKind::invalid_value, pointer, image.error().issues.front().message});
  return {image->width, image->height, std::move(image->values)};
}

}  // namespace

void Obstacles::add_footprints(Array<Footprint> footprints) {
  if (footprints.empty()) return;
  double widest = 0;
  for (const Footprint& each : footprints) widest = std::max(widest, each.reach());
  Neighbours by_position(extent_, 2 * widest, job_);
  for (std::size_t i = 0; i < footprints.size(); ++i)
    by_position.add(footprints[i].at, static_cast<std::uint32_t>(i));
  groups_.push_back({std::move(footprints), widest, std::move(by_position)});
}

bool Obstacles::intersects(const glm::dvec2& p, double reach) const {
  for (const PathBand& band : paths_) {
    if (band.covers(p, reach)) return true;
  }
  for (const Group& group : groups_) {
    const bool met = group.by_position.any(p, group.widest + reach, [&](std::uint32_t id, double) {
      return group.footprints[id].outside(p) < reach;
    });
    if (met) return true;
  }
  return false;
}

double DensityImage::at(const glm::dvec2& position) const {
  const double x = std::clamp(position.x * width - 0.5, 0.0, width - 1.0);
  const double z = std::clamp(position.y * depth - 0.5, 0.0, depth - 1.0);
  const std::size_t i = math::to_uint32(x), j = math::to_uint32(z);
  const std::size_t right = std::min<std::size_t>(i + 1, width - 1),
                    below = std::min<std::size_t>(j + 1, depth - 1);
  const double u = x - static_cast<double>(i), v = z - static_cast<double>(j);
  const auto value = [&](std::size_t column, std::size_t row) {
    return static_cast<double>(share[row * width + column]);
  };
  const double north = value(i, j) + (value(right, j) - value(i, j)) * u;
  const double south = value(i, below) + (value(right, below) - value(i, below)) * u;
  return north + (south - north) * v;
}

double patch_noise(const glm::dvec2& p, std::uint64_t key) {
  double sum = 0, amplitude = 1;
  glm::dvec2 position = p;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * gradient_noise(position, key_at(key, static_cast<std::uint64_t>(octave)));
    amplitude /= 2;
    position *= 2.0;
  }
  return sum;
}

double shade_at(const glm::dvec2& p, const std::vector<PlacedLayer>& planted, std::size_t before) {
  double light = 1;
  for (std::size_t layer = 0; layer < before; ++layer) {
    const PlacedLayer& each = planted[layer];
    if (!each.by_position || each.widest_crown <= 0) continue;
    // Apart from rounding, the product does not depend on the order of its factors. The order is that of the
    // grid.
    each.by_position->any(p, each.widest_crown, [&](std::uint32_t id, double squared) {
      const double crown = each.crown * static_cast<double>((*each.placements)[id].scale);
      if (squared < crown * crown) light *= squared / (crown * crown);
      return false;
    });
  }
  return 1 - light;
}

Rules::Rules(Inputs given, const std::string& pointer, const Job& job) : inputs_(std::move(given)) {
  if (inputs_.place.area) {
    for (const auto& p : *inputs_.place.area) area_.emplace_back(p[0], p[1]);
  }
  if (inputs_.place.density_image)
    image_ = read_image(*inputs_.place.density_image, pointer + "/density_image", job);
}

double Rules::share(const glm::dvec2& p, double reach) const {
  const ScenePlace& place = inputs_.place;
  if (!inputs_.ground.contains(p, place.edge)) return 0;
  if (!area_.empty() && !is_inside(area_, p)) return 0;
  double share = place.density * share_of_ground(p);
  if (share > 0 && image_) {
    const Extent& extent = inputs_.ground.extent();
    share *= image_->at((p - extent.min) / extent.size());
  }
  if (share > 0 && place.noise) share *= share_of_noise(*place.noise, p, inputs_.noise_key);
  if (share > 0 && inputs_.obstacles.intersects(p, reach)) return 0;
  return share > 0 ? share * share_of_neighbours(p) : 0;
}

double Rules::share_of_ground(const glm::dvec2& p) const {
  const ScenePlace& place = inputs_.place;
  double share = 1;
  if (place.slope) {
    const double steep = math::degrees(math::atan2(glm::length(inputs_.ground.gradient(p)), 1));
    share *= share_of_limits(*place.slope, steep);
  }
  if (share > 0 && place.ground) share *= inputs_.ground.share_of(*place.ground, p);
  const std::optional<double>& water = inputs_.ground.water();
  if (!place.altitude && !water && !place.above_water) return share;
  const double height = inputs_.ground.height(p);
  if (place.altitude) share *= share_of_limits(*place.altitude, height);
  if (place.above_water) {
    // Without water, all ground counts as far above it.
    share *= water ? share_of_limits(*place.above_water, height - *water) : (place.above_water->to ? 0 : 1);
  } else if (water && height < *water) {
    return 0;
  }
  return share;
}

double Rules::share_of_neighbours(const glm::dvec2& p) const {
  const ScenePlace& place = inputs_.place;
  for (std::size_t i = 0; i < place.near.size(); ++i) {
    const SceneNeighbour& near = place.near[i];
    const PlacedLayer& other = inputs_.planted[inputs_.near[i]];
    const auto within = [&](double radius) {
      return other.by_position &&
             other.by_position->any(p, radius, [](std::uint32_t, double) { return true; });
    };
    if (near.from && *near.from > 0 && within(*near.from)) return 0;
    if (near.to && !within(*near.to)) return 0;
  }
  return place.shade ? share_of_limits(*place.shade, shade_at(p, inputs_.planted, inputs_.planted.size()))
                     : 1;
}

bool Rules::reads_neighbours(const ScenePlace& place) {
  return !place.near.empty() || place.shade.has_value();
}

}  // namespace seedmesh::scene
