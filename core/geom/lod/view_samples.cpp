#include "core/geom/lod/view_samples.h"

#include <cmath>
#include <iterator>

namespace seedmesh {
namespace {

// Elevations of consecutive views above the horizon, in radians.
constexpr double elevations[] = {0.15, 0.4, -0.05, 0.25};
// Offset of the first view, so that no view is along an axis.
constexpr double first_view = 0.37;

}  // namespace

ViewSamples::ViewSamples(const Box& box, int views) {
  const glm::dvec3 extent = glm::dvec3(box.max) - glm::dvec3(box.min);
  middle_ = 0.5 * (glm::dvec3(box.max) + glm::dvec3(box.min));
  const double size = std::sqrt(glm::dot(extent, extent));
  scale_ = size > 0 ? across / size : 1;
  for (int i = 0; i < views; ++i) {
    const math::SinCos turn = math::sincos(math::pi * (i + first_view) / views);
    const math::SinCos rise = math::sincos(elevations[static_cast<std::size_t>(i) % std::size(elevations)]);
    const glm::dvec3 right(-turn.sin, 0, turn.cos);
    const glm::dvec3 from(turn.cos * rise.cos, rise.sin, turn.sin * rise.cos);
    views_.push_back({right, glm::cross(from, right)});
  }
}

}  // namespace seedmesh
