#include "core/generators/scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/scene/buildings.h"
#include "core/generators/scene/place_layers.h"
#include "core/generators/scene/sampled_share.h"
#include "core/generators/scene/shapes.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"

namespace seedmesh::scene {
namespace {

constexpr double poisson_density = 0.67;     ///< positions in a square with the distance as side
constexpr std::uint64_t bytes_a_node = 230;  ///< size of a copy in core glTF: one line of JSON
// Bones of a growing plant and their key times; joints and weights add four fifths to its mesh. Measured on the presets.
constexpr std::uint64_t bytes_a_growing_copy = 16'000;
constexpr std::uint64_t grid_to_reduced = 8;    ///< approximate triangles of a grid for one of a reduced mesh
constexpr std::uint64_t bytes_a_triangle = 24;  ///< size of a triangle of a reduced mesh
constexpr std::uint64_t bytes_an_outline_triangle = 66;  ///< bytes of a building with a node of its own

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
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += std::sqrt((points[i][0] - points[i - 1][0]) * (points[i][0] - points[i - 1][0]) +
                        (points[i][1] - points[i - 1][1]) * (points[i][1] - points[i - 1][1]));
  }
  return length;
}

/// Returns the capacity of the pattern.
double capacity_of(const ScenePlace& place, const Extent& extent) {
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
  IssueList errors;
  return read_terrain(Json::parse(params.terrain->parameters), "", errors);
}

double known_width(const SceneParams& params) {
  return params.terrain ? terrain_of(params).size : params.ground.value_or(SceneGround{}).size;
}

std::optional<Estimate> ground_of(const SceneParams& params, const GenerateContext& context) {
  if (!params.terrain) {
    const SceneOutline outline = params.ground.value_or(SceneGround{}).outline;
    switch (outline) {
      case SceneOutline::none:
        return Estimate{0, 100, true};
      case SceneOutline::disc:
        return Estimate{94, 3200, true};
      default:
        return Estimate{2, 800, true};
    }
  }
  const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), context);
  if (!own || own->estimate) return own ? own->estimate : std::nullopt;
  const int side = terrain::finished_side(terrain_of(params));
  const auto squares = static_cast<std::uint64_t>(std::max(side - 1, 0));
  const std::uint64_t triangles = 2 * squares * squares / grid_to_reduced;
  return Estimate{triangles, triangles * bytes_a_triangle, false};
}

std::uint64_t whole(double value) { return static_cast<std::uint64_t>(math::to_int64(value)); }

/// Returns the estimates of a layer's variants. A variant without estimate counts as the mean of the others.
/// Returns nullopt where none has one.
std::optional<std::vector<Estimate>> layer_estimates(const VariantTable::Layer& variants,
                                                     const std::vector<std::optional<Estimate>>& estimates) {
  std::vector<std::size_t> numbers;
  for (std::uint32_t i = variants.first; i < variants.first + variants.count; ++i) numbers.push_back(i);
  for (const std::uint32_t i : variants.by_position) {
    if (i < estimates.size()) numbers.push_back(i);
  }
  double triangles = 0, bytes = 0, known = 0;
  for (const std::size_t i : numbers) {
    if (!estimates[i]) continue;
    triangles += static_cast<double>(estimates[i]->triangles);
    bytes += static_cast<double>(estimates[i]->bytes - image_bytes(*estimates[i]));
    ++known;
  }
  if (known == 0) return std::nullopt;
  const auto mean = [known](double sum) { return whole(sum / known); };
  std::vector<Estimate> all;
  for (const std::size_t i : numbers)
    all.push_back(estimates[i].value_or(Estimate{mean(triangles), mean(bytes), false}));
  return all;
}

/// Adds the bytes of merged copies beyond the first of each model.
void add_copies_of(Estimate& sum, const std::vector<Estimate>& models, double placements) {
  double bytes = 0;
  for (const Estimate& each : models) bytes += static_cast<double>(each.bytes - image_bytes(each));
  const auto count = static_cast<double>(models.size());
  if (placements > count) sum.bytes += whole(bytes / count * (placements - count));
}

/// Expected placements under the rules that depend on the ground, whose field is computed at most once.
class Sampler {
 public:
  Sampler(const SceneParams& params, const Job& job) : params_(params), job_(job) {}

  double placements(std::size_t number, const Extent& extent) {
    const SceneLayer& layer = params_.layers[number];
    const ScenePlace& place = layer.place;
    const double all = expected_placements(layer, extent);
    const bool has_water = params_.terrain && terrain_of(params_).water_level;
    if (place.method == SceneMethod::positions || !(depends_on_ground(place) || has_water)) return all;
    const Ground* ground = field();
    if (!ground) return all;
    const double share = sampled_share(layer, number, *ground, job_);
    if (place.method == SceneMethod::scatter || place.method == SceneMethod::clusters)
      return std::min(all, share * place.density * static_cast<double>(tries_of_series(layer)));
    const double kept = capacity_of(place, extent) * place.density * share;
    return place.count ? std::min(kept, static_cast<double>(*place.count)) : kept;
  }

 private:
  /// Null where the field would cost too much, or cannot be made.
  const Ground* field() {
    constexpr std::int64_t longest_side = 2'049;
    if (std::exchange(is_tried_, true)) return ground_ ? &*ground_ : nullptr;
    if (params_.terrain && terrain::finished_side(terrain_of(params_)) > longest_side) return nullptr;
    Result<Ground> made = Ground::make(params_, job_);
    if (made) ground_.emplace(std::move(*made));
    return ground_ ? &*ground_ : nullptr;
  }

  const SceneParams& params_;
  const Job& job_;
  bool is_tried_ = false;
  std::optional<Ground> ground_;
};

}  // namespace

std::optional<Extent> known_extent(const SceneParams& params) {
  if (params.terrain && terrain_of(params).algorithm == TerrainAlgorithm::image) return std::nullopt;
  return square_of(known_width(params));
}

double expected_placements(const SceneLayer& layer, const Extent& extent) {
  const ScenePlace& place = layer.place;
  const double capacity = capacity_of(place, extent);
  if (place.method == SceneMethod::scatter || place.method == SceneMethod::clusters) return capacity;
  const double kept = capacity * place.density;
  return place.count ? std::min(kept, static_cast<double>(*place.count)) : kept;
}

std::optional<Estimate> estimate_of(const SceneParams& params, const VariantTable& variant_table,
                                    const std::vector<std::optional<Estimate>>& estimates,
                                    const GenerateContext& context) {
  std::optional<Estimate> ground = ground_of(params, context);
  if (!ground) return std::nullopt;
  if (const std::uint64_t outlines = expected_triangles(params); outlines > 0)
    *ground = {ground->triangles + outlines, ground->bytes + outlines * bytes_an_outline_triangle, false,
               ground->images};
  bool exact = ground->exact && params.paths.empty() && !params.camera;
  const Extent extent = square_of(known_width(params));
  Estimate sum = *std::move(ground);
  const bool merges = context.demand.copies == CopyForm::merge;
  double triangles = static_cast<double>(sum.triangles);
  std::uint64_t copies = 0;
  Sampler sampler(params, context.job);
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const VariantTable::Layer& variants = variant_table.layers[i];
    const auto models = layer_estimates(variants, estimates);
    if (!models) return std::nullopt;
    double own = 0, mean = 0;  // triangles of positions with their own model; mean of the variants
    for (std::size_t k = 0; k < models->size(); ++k) {
      const Estimate& each = (*models)[k];
      add_bytes(sum, each);
      exact = exact && each.exact;
      if (k >= variants.count) {
        own += static_cast<double>(each.triangles);
        continue;
      }
      mean += static_cast<double>(each.triangles) / variants.count;
      exact = exact && each.triangles == models->front().triangles;
    }
    const double placements = sampler.placements(i, extent);
    if (merges) add_copies_of(sum, *models, placements);
    exact = exact && params.layers[i].place.method == SceneMethod::positions;
    triangles += own + mean * (placements - static_cast<double>(models->size() - variants.count));
    sum.bytes += whole(placements) * bytes_a_node;
    copies += whole(placements);
  }
  if (context.demand.growth) sum.bytes += (sum.bytes - image_bytes(sum) - copies * bytes_a_node) * 4 / 5;
  if (context.demand.growth) sum.bytes += copies * bytes_a_growing_copy;
  sum.triangles = whole(triangles);
  sum.exact = exact;
  return sum;
}

}  // namespace seedmesh::scene
