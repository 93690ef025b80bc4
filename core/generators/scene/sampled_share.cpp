#include "core/generators/scene/sampled_share.h"

#include <algorithm>
#include <string>

#include "core/generators/scene/place_layers.h"
#include "core/generators/scene/rules.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t samples_a_side = 256;  ///< of a grid over the area, one sample at random in each square
constexpr std::size_t samples_of_a_path = 4'096;

/// The sum of shares over positions, and their number.
struct Mean {
  double sum = 0;
  double count = 0;
  void add(double share) { sum += share, ++count; }
  double value() const { return count > 0 ? sum / count : 1; }
};

/// The smallest rectangle around the area, or the whole ground.
Extent sampled_extent(const ScenePlace& place, const Extent& whole) {
  if (!place.area) return whole;
  Extent part{whole.max, whole.min};
  for (const auto& corner : *place.area) {
    const glm::dvec2 p(corner[0], corner[1]);
    part = {glm::min(part.min, p), glm::max(part.max, p)};
  }
  return {glm::max(part.min, whole.min), glm::min(part.max, whole.max)};
}

double share_of_area(const ScenePlace& place, const Rules& rules, const Extent& whole, const Rng& rng,
                     const Job& job) {
  const Extent part = sampled_extent(place, whole);
  const glm::dvec2 square = part.size() / static_cast<double>(samples_a_side);
  Mean mean;
  for (std::size_t row = 0; row < samples_a_side; ++row) {
    job.check();
    const Rng of_row = rng.at(row);
    for (std::size_t column = 0; column < samples_a_side; ++column) {
      Rng own = of_row.at(column);
      const double x = own.unit(), z = own.unit();
      const glm::dvec2 inside(x, z);
      const glm::dvec2 p = part.min + (glm::dvec2(column, row) + inside) * square;
      if (rules.area().empty() || is_inside(rules.area(), p)) mean.add(rules.share(p, 0));
    }
  }
  return mean.value();
}

double share_of_path(const ScenePlace& place, const Rules& rules) {
  const auto& points = *place.points;
  const auto at = [&](std::size_t i) { return glm::dvec2(points[i][0], points[i][1]); };
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::length(at(i) - at(i - 1));
  const double step = length / samples_of_a_path;
  Mean mean;
  double next = step / 2;  // from the start of the present segment
  for (std::size_t i = 1; i < points.size() && step > 0; ++i) {
    const glm::dvec2 along = at(i) - at(i - 1);
    const double own = glm::length(along);
    for (; next < own; next += step) mean.add(rules.share(at(i - 1) + along * (next / own), 0));
    next -= own;
  }
  return mean.value();
}

}  // namespace

bool depends_on_ground(const ScenePlace& place) {
  return place.ground || place.slope || place.altitude || place.above_water || place.density_image ||
         place.noise || place.edge > 0;
}

double sampled_share(const SceneLayer& layer, std::size_t number, const Ground& ground, const Job& job) {
  ScenePlace place = layer.place;
  place.near.clear();
  place.shade.reset();
  place.density = 1;
  const Obstacles obstacles(ground.extent(), job);
  const std::vector<PlacedLayer> planted;
  const Rng rng = stream_of(layer, number, job);
  const Rules rules({place, ground, obstacles, planted, {}, rng.at("noise").key()},
                    "/layers/" + std::to_string(number) + "/place", job);
  if (place.method == SceneMethod::path) return share_of_path(place, rules);
  return share_of_area(place, rules, ground.extent(), rng.at("estimate"), job);
}

}  // namespace seedmesh::scene
