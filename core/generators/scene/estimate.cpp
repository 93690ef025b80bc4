#include "core/generators/scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/scene/shapes.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"

namespace seedmesh::scene {
namespace {

constexpr double poisson_density = 0.65;     ///< places in a square of their distance
constexpr std::uint64_t bytes_a_node = 230;  ///< of a copy in core glTF, its line of JSON
constexpr Estimate square{2, 800, true}, disc{94, 3200, true}, none{0, 100, true};

double area_of(const ScenePlace& place, const Extent& extent) {
  const double whole = extent.size().x * extent.size().y;
  if (!place.area) return whole;
  double twice = 0;
  const auto& corners = *place.area;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    twice += corners[j][0] * corners[i][1] - corners[i][0] * corners[j][1];
  return std::min(whole, std::abs(twice) / 2);
}

double length_of(const std::vector<std::array<double, 2>>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::sqrt((points[i][0] - points[i - 1][0]) * (points[i][0] - points[i - 1][0]) +
                        (points[i][1] - points[i - 1][1]) * (points[i][1] - points[i - 1][1]));
  return length;
}

/// That the pattern has room for.
double room_of(const ScenePlace& place, const Extent& extent) {
  switch (place.method) {
    case SceneMethod::poisson:
      return poisson_density * area_of(place, extent) / (*place.distance * *place.distance);
    case SceneMethod::rows:
      return area_of(place, extent) / ((*place.spacing)[0] * (*place.spacing)[1]);
    case SceneMethod::path: {
      const bool both = place.offset > 0 && place.side == SceneSide::both;
      return length_of(*place.points) / *place.distance * (both ? 2 : 1);
    }
    case SceneMethod::positions:
      return static_cast<double>(place.positions.size());
    default:
      return static_cast<double>(*place.count);
  }
}

/// The square of the ground.
Extent extent_told(const SceneParams& params) {
  double size = params.ground.value_or(SceneGround{}).size;
  if (params.terrain) {
    Faults faults;
    size = read_terrain(Json::parse(params.terrain->parameters), "", faults).size;
  }
  return {glm::dvec2(-size / 2), glm::dvec2(size / 2)};
}

std::optional<Estimate> ground_of(const SceneParams& params, const Job& job) {
  if (!params.terrain) {
    const SceneOutline outline = params.ground.value_or(SceneGround{}).outline;
    return outline == SceneOutline::none ? none : outline == SceneOutline::disc ? disc : square;
  }
  const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), job);
  return own ? own->estimate : std::nullopt;
}

struct Sum {
  double triangles = 0, bytes = 0;
};

}  // namespace

double expected_stands(const SceneLayer& layer, const Extent& extent) {
  const ScenePlace& place = layer.place;
  const double room = room_of(place, extent);
  if (place.method == SceneMethod::scatter || place.method == SceneMethod::clusters) return room;
  const double kept = room * place.density;
  return place.count ? std::min(kept, static_cast<double>(*place.count)) : kept;
}

std::optional<Estimate> estimate_of(const SceneParams& params, const Casting& casting,
                                    const std::vector<std::optional<Estimate>>& estimates, const Job& job) {
  const std::optional<Estimate> ground = ground_of(params, job);
  if (!ground || std::any_of(estimates.begin(), estimates.end(), [](const auto& each) { return !each; }))
    return std::nullopt;
  bool exact = ground->exact && params.paths.empty() && !params.camera;
  const Extent extent = extent_told(params);
  Sum sum{static_cast<double>(ground->triangles), static_cast<double>(ground->bytes)};
  for (const auto& each : estimates) sum.bytes += static_cast<double>(each->bytes);
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const Casting::Layer& casts = casting.layers[i];
    double own = 0, variants = 0;  // triangles of positions with a model of their own; mean of the variants
    std::size_t with_own = 0;
    for (const std::uint32_t cast : casts.by_position) {
      if (cast >= estimates.size()) continue;
      own += static_cast<double>(estimates[cast]->triangles);
      ++with_own;
    }
    for (std::uint32_t cast = casts.first; cast < casts.first + casts.count; ++cast) {
      variants += static_cast<double>(estimates[cast]->triangles) / casts.count;
      exact =
          exact && estimates[cast]->exact && estimates[cast]->triangles == estimates[casts.first]->triangles;
    }
    const double stands = expected_stands(params.layers[i], extent);
    exact = exact && params.layers[i].place.method == SceneMethod::positions;
    sum.triangles += own + variants * (stands - static_cast<double>(with_own));
    sum.bytes += stands * static_cast<double>(bytes_a_node);
  }
  const auto whole = [](double value) { return static_cast<std::uint64_t>(math::to_int64(value)); };
  return Estimate{whole(sum.triangles), whole(sum.bytes), exact};
}

}  // namespace seedmesh::scene
