#include "core/generators/scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/scene/shapes.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"

namespace seedmesh::scene {
namespace {

constexpr double poisson_density = 0.65;        ///< places in a square of their distance
constexpr std::uint64_t bytes_a_node = 230;     ///< of a copy in core glTF, its line of JSON
constexpr std::uint64_t grid_to_reduced = 8;    ///< triangles of a grid for one of a reduced mesh, about
constexpr std::uint64_t bytes_a_triangle = 24;  ///< of a reduced mesh
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

Extent square_of(double size) { return {glm::dvec2(-size / 2), glm::dvec2(size / 2)}; }

TerrainParams terrain_of(const SceneParams& params) {
  Faults faults;
  return read_terrain(Json::parse(params.terrain->parameters), "", faults);
}

double width_told(const SceneParams& params) {
  return params.terrain ? terrain_of(params).size : params.ground.value_or(SceneGround{}).size;
}

std::optional<Estimate> ground_of(const SceneParams& params, const Job& job) {
  if (!params.terrain) {
    const SceneOutline outline = params.ground.value_or(SceneGround{}).outline;
    return outline == SceneOutline::none ? none : outline == SceneOutline::disc ? disc : square;
  }
  const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), job);
  if (!own || own->estimate) return own ? own->estimate : std::nullopt;
  const int side = terrain::finished_side(terrain_of(params));
  const auto squares = static_cast<std::uint64_t>(std::max(side - 1, 0));
  const std::uint64_t triangles = 2 * squares * squares / grid_to_reduced;
  return Estimate{triangles, triangles * bytes_a_triangle, false};
}

/// What the models of a layer have; those that cannot tell count as the mean of the others. Nothing where
/// none can tell.
std::optional<std::vector<Estimate>> models_told(const Casting::Layer& casts,
                                                 const std::vector<std::optional<Estimate>>& estimates) {
  std::vector<std::size_t> numbers;
  for (std::uint32_t i = casts.first; i < casts.first + casts.count; ++i) numbers.push_back(i);
  for (const std::uint32_t i : casts.by_position) {
    if (i < estimates.size()) numbers.push_back(i);
  }
  double triangles = 0, bytes = 0, known = 0;
  for (const std::size_t i : numbers) {
    if (!estimates[i]) continue;
    triangles += static_cast<double>(estimates[i]->triangles);
    bytes += static_cast<double>(estimates[i]->bytes);
    ++known;
  }
  if (known == 0) return std::nullopt;
  const auto mean = [known](double sum) { return static_cast<std::uint64_t>(math::to_int64(sum / known)); };
  std::vector<Estimate> all;
  for (const std::size_t i : numbers)
    all.push_back(estimates[i].value_or(Estimate{mean(triangles), mean(bytes), false}));
  return all;
}

struct Sum {
  double triangles = 0, bytes = 0;
};

}  // namespace

std::optional<Extent> extent_told(const SceneParams& params) {
  if (params.terrain && terrain_of(params).algorithm == TerrainAlgorithm::image) return std::nullopt;
  return square_of(width_told(params));
}

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
  if (!ground) return std::nullopt;
  bool exact = ground->exact && params.paths.empty() && !params.camera;
  const Extent extent = square_of(width_told(params));
  Sum sum{static_cast<double>(ground->triangles), static_cast<double>(ground->bytes)};
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const Casting::Layer& casts = casting.layers[i];
    const auto models = models_told(casts, estimates);
    if (!models) return std::nullopt;
    double own = 0, variants = 0;  // triangles of positions with a model of their own; mean of the variants
    for (std::size_t k = 0; k < models->size(); ++k) {
      const Estimate& each = (*models)[k];
      sum.bytes += static_cast<double>(each.bytes);
      exact = exact && each.exact;
      if (k >= casts.count) {
        own += static_cast<double>(each.triangles);
        continue;
      }
      variants += static_cast<double>(each.triangles) / casts.count;
      exact = exact && each.triangles == models->front().triangles;
    }
    const double stands = expected_stands(params.layers[i], extent);
    exact = exact && params.layers[i].place.method == SceneMethod::positions;
    sum.triangles += own + variants * (stands - static_cast<double>(models->size() - casts.count));
    sum.bytes += stands * static_cast<double>(bytes_a_node);
  }
  const auto whole = [](double value) { return static_cast<std::uint64_t>(math::to_int64(value)); };
  return Estimate{whole(sum.triangles), whole(sum.bytes), exact};
}

}  // namespace seedmesh::scene
