#include "core/generators/scene/patterns.h"

#include <optional>
#include <string>

#include "core/base/math.h"
#include "core/generators/scene/estimate.h"
#include "core/generators/scene/shapes.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

std::vector<glm::dvec2> points_of(const std::vector<std::array<double, 2>>& given) {
  std::vector<glm::dvec2> points;
  for (const auto& p : given) points.emplace_back(p[0], p[1]);
  return points;
}

RowPlan row_plan(const ScenePlace& place) {
  return {
      {(*place.spacing)[0], (*place.spacing)[1]}, math::radians(place.angle), place.stagger, place.jitter};
}

PathPlan way_plan(const ScenePlace& place) {
  return {*place.distance, place.offset, place.side != SceneSide::right, place.side != SceneSide::left,
          place.jitter};
}

void refuse_pattern(const ScenePlace& place, const std::optional<Extent>& ground, const Job& job) {
  switch (place.method) {
    case SceneMethod::rows:
      if (ground) refuse_rows(part_of(place, *ground), row_plan(place), job);
      return;
    case SceneMethod::path:
      return refuse_along(points_of(*place.points), way_plan(place), job);
    case SceneMethod::poisson:
      if (ground) refuse_poisson_disk(*ground, part_of(place, *ground), *place.distance, job);
      return;
    default:
      return;
  }
}

}  // namespace

const char* amount_of(SceneMethod method) {
  switch (method) {
    case SceneMethod::scatter:
    case SceneMethod::clusters:
      return "/count";
    case SceneMethod::rows:
      return "/spacing";
    case SceneMethod::positions:
      return "/positions";
    default:
      return "/distance";
  }
}

Extent part_of(const ScenePlace& place, const Extent& ground) {
  if (!place.area) return ground;
  const Extent area = extent_of(points_of(*place.area));
  return {glm::clamp(area.min, ground.min, ground.max), glm::clamp(area.max, ground.min, ground.max)};
}

Array<Placement> pattern_of(const ScenePlace& place, const Extent& ground, Rng rng, const Job& job) {
  switch (place.method) {
    case SceneMethod::rows:
      return in_rows(part_of(place, ground), row_plan(place), rng, job);
    case SceneMethod::path:
      return along(points_of(*place.points), way_plan(place), rng, job);
    default:
      return poisson_disk(ground, part_of(place, ground), *place.distance, rng, job);
  }
}

void refuse_patterns(const SceneParams& params, Job job) {
  const std::optional<Extent> ground = known_extent(params);
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const ScenePlace& place = params.layers[i].place;
    const Job::PointerScope scope(job, "/layers/" + std::to_string(i) + "/place" + amount_of(place.method));
    refuse_pattern(place, ground, job);
  }
}

}  // namespace seedmesh::scene
