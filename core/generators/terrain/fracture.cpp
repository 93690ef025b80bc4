#include "core/generators/terrain/fracture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t points_a_chunk = 1024;
// Deviation of the logarithm of the thickness of layers.
constexpr double layer_deviation = 0.55;
// Share of a layer over which its recess changes to that of the next one.
constexpr double ledge = 0.3;
// The largest wavelength of the noise, as a share of the radius, and its octaves.
constexpr double noise_wavelength = 0.55;
constexpr int noise_octaves = 6;

struct Plane {
  glm::dvec3 normal;
  double distance;
};

/// A border between layers and how far the layer above it recedes, 0 to 1.
struct Bed {
  double from, recess;
};

glm::dvec3 random_direction(Rng& draw) {
  const double y = draw.uniform(-1, 1), flat = std::sqrt(1 - y * y);
  const math::SinCos turn = math::sincos(draw.uniform(0, 2 * math::pi));
  return {flat * turn.cos, y, flat * turn.sin};
}

/// About normal, mean 0 and deviation 1: the sum of four uniform numbers.
double deviate(Rng& draw) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += draw.uniform(-1, 1);
  return sum * 0.8660254037844386;
}

/// The lesser of two distances, rounded where they differ by less than `width`.
double smooth_least(double a, double b, double width) {
  const double near = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * near * near;
}

class Rock {
 public:
  Rock(const FracturePlan& plan, double radius, Rng rng) : plan_(plan) {
    for (int i = 0; i < plan.planes; ++i) {
      Rng draw = rng.at("plane").at(static_cast<std::uint64_t>(i));
      const glm::dvec3 normal = random_direction(draw), reach = normal * plan.axes;
      const double touching = std::sqrt(glm::dot(reach, reach));
      planes_.push_back({normal, touching * draw.uniform(plan.nearest, plan.farthest)});
    }
    Rng draw = rng.at("layers");
    const math::SinCos tilt = math::sincos_degrees(plan.tilt),
                       turn = math::sincos(draw.uniform(0, 2 * math::pi));
    across_ = {tilt.sin * turn.cos, tilt.cos, tilt.sin * turn.sin};
    for (double at = -1.3; plan.strata > 0 && at < 1.3;) {
      beds_.push_back({at, draw.uniform(0, 1)});
      at += std::max(plan.layer, 0.02) * std::clamp(math::exp(layer_deviation * deviate(draw)), 0.45, 3.0);
    }
    grain_.octaves = noise_octaves;
    grain_.gain = 0.55;
    grain_.wavelength = noise_wavelength * radius;
    grain_.amplitude = plan.roughness;
  }

  /// The distance of the surface from the centre in a direction, in radii, without noise.
  double radius_at(const glm::dvec3& direction) const {
    const glm::dvec3 scaled = direction / plan_.axes;
    double radius = 1 / std::sqrt(glm::dot(scaled, scaled));
    const double width = std::max(plan_.bevel, 1e-4);
    for (const Plane& plane : planes_) {
      const double facing = glm::dot(plane.normal, direction);
      if (facing > 1e-3) radius = smooth_least(radius, plane.distance / facing, width);
    }
    return beds_.empty() ? radius : radius - plan_.strata * recess_at(radius * glm::dot(direction, across_));
  }

  const NoisePlan& grain() const { return grain_; }

 private:
  /// How far the stone recedes at a height across the layers.
  double recess_at(double height) const {
    const auto next = std::upper_bound(beds_.begin(), beds_.end(), height,
                                       [](double value, const Bed& bed) { return value < bed.from; });
    if (next == beds_.begin() || next == beds_.end()) return beds_.back().recess;
    const Bed& here = *(next - 1);
    const double width = ledge * (next->from - here.from);
    const double share = std::clamp((height - (next->from - width)) / width, 0.0, 1.0);
    return here.recess + (next->recess - here.recess) * share * share * (3 - 2 * share);
  }

  FracturePlan plan_;
  std::vector<Plane> planes_;
  std::vector<Bed> beds_;
  glm::dvec3 across_{0, 1, 0};
  NoisePlan grain_;
};

}  // namespace

void fracture_sphere(Planet& planet, const FracturePlan& plan, Rng rng, const Job& job) {
  const Rock rock(plan, planet.radius, rng.at("fracture"));
  const Rng grain = rng.at("grain");
  parallel_for(job, planet.direction.size(), points_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 SpaceNoise noise(rock.grain(), grain);
                 for (std::size_t i = begin; i < end; ++i) {
                   const glm::dvec3 direction(planet.direction[i]);
                   double radius = planet.radius * rock.radius_at(direction);
                   if (plan.roughness > 0) radius += noise.at(direction * radius);
                   planet.height[i] = static_cast<float>(radius - planet.radius);
                 }
               });
}

}  // namespace seedmesh::terrain
