#include "core/generators/terrain/layer_algorithms.h"

#include <algorithm>
#include <string>

#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

using Source = TerrainLayerAlgorithm;

constexpr int most_rounds = 14;

bool is_subdivision(Source source) {
  return source == Source::diamond_square || source == Source::square_square ||
         source == Source::triangular_edge;
}

TerrainAlgorithm algorithm_of(Source source) {
  switch (source) {
    case Source::fault_formation:
      return TerrainAlgorithm::fault_formation;
    case Source::poisson_faulting:
      return TerrainAlgorithm::poisson_faulting;
    case Source::triangular_edge:
      return TerrainAlgorithm::triangular_edge;
    case Source::diamond_square:
      return TerrainAlgorithm::diamond_square;
    case Source::square_square:
      return TerrainAlgorithm::square_square;
    case Source::fbm:
      return TerrainAlgorithm::fbm;
    case Source::expression:
      break;
  }
  return TerrainAlgorithm::expression;
}

/// The rounds that make the first square as large as a field of `side` samples.
int rounds_across(std::int32_t side) {
  int rounds = 1;
  while (rounds < most_rounds && (std::int32_t{1} << rounds) < side - 1) ++rounds;
  return rounds;
}

/// The request of a layer's algorithm. `side`: samples of the field where the terrain is an image.
TerrainParams params_of(const TerrainParams& params, const TerrainLayer& layer, std::int32_t side) {
  TerrainParams own;
  own.algorithm = algorithm_of(layer.layer_algorithm);
  own.shape = params.shape;
  own.size = params.size;
  own.tile = params.tile;
  const int samples = params.algorithm == TerrainAlgorithm::image ? side : made_side(params);
  own.resolution = samples;
  own.iterations = layer.iterations;
  if (is_subdivision(layer.layer_algorithm) && !own.iterations) own.iterations = rounds_across(samples);
  own.amplitude = layer.amplitude;
  own.hurst = layer.hurst;
  own.wavelength = layer.wavelength;
  if (layer.layer_noise) own.noise = static_cast<TerrainNoise>(*layer.layer_noise);
  own.fault_max = layer.fault_max;
  own.fault_min = layer.fault_min;
  return own;
}
static_assert(static_cast<int>(TerrainLayerNoise::billow) == static_cast<int>(TerrainNoise::billow) &&
              static_cast<int>(TerrainLayerNoise::ridged) == static_cast<int>(TerrainNoise::ridged));

}  // namespace

void check_layer_algorithm(const TerrainParams& params, std::size_t index, std::vector<Issue>& issues) {
  const TerrainLayer& layer = params.layers[index];
  const Source source = layer.layer_algorithm;
  const bool is_text = source == Source::expression, is_noise = source == Source::fbm,
             is_divided = is_subdivision(source),
             is_fault = source == Source::fault_formation || source == Source::poisson_faulting;
  const std::string own = "/layers/" + std::to_string(index) + "/";
  const auto belongs = [&](bool is_given, bool is_owner, const char* name, const char* owners) {
    if (is_given && !is_owner) {
      issues.emplace_back(conflict_with({"algorithm"}), own + name,
                          std::string("this algorithm has no ") + name + "; only " + owners + " have it");
    }
  };
  belongs(layer.expression.has_value(), is_text, "expression", "layers of the algorithm expression");
  belongs(layer.iterations.has_value(), !is_text, "iterations", "faults, fbm and subdivisions");
  belongs(layer.amplitude.has_value(), is_noise || is_divided, "amplitude", "fbm and subdivisions");
  belongs(layer.hurst.has_value(), is_noise || is_divided, "hurst", "fbm and subdivisions");
  belongs(layer.wavelength.has_value(), is_noise, "wavelength", "layers of fbm");
  belongs(layer.layer_noise.has_value(), is_noise, "noise", "layers of fbm");
  belongs(layer.fault_max.has_value(), is_fault, "fault_max", "faults");
  belongs(layer.fault_min.has_value(), is_fault, "fault_min", "faults");
  if (!is_divided) return;
  if (params.shape == TerrainShape::sphere) {
    issues.emplace_back(
        IssueKind::not_available, own + "algorithm",
        "a sphere has no subdivision; expected expression, fault_formation, poisson_faulting or fbm");
  }
  if (layer.iterations && *layer.iterations > most_rounds) {
    issues.emplace_back(IssueKind::out_of_range, own + "iterations",
                        "found " + std::to_string(*layer.iterations) + "; expected at most " +
                            std::to_string(most_rounds) + " rounds of subdivision");
  }
}

Field layer_field(const TerrainParams& params, const TerrainLayer& layer, const Window& window,
                  const LayerSource& source, const Job& job) {
  const TerrainParams own = params_of(params, layer, std::max(window.width, window.depth));
  if (layer.layer_algorithm == Source::square_square)
    return subdivide_nested(nested_plan(own), window, source.rng, job);
  if (is_subdivision(layer.layer_algorithm))
    return subdivide(square_plan(own), World::unbounded, window, source.rng, job);
  return algorithm_field(own, window, source.cell, source.rng, job);
}

void layer_sphere(const TerrainParams& params, const TerrainLayer& layer, Planet& planet, Rng rng,
                  const Job& job) {
  algorithm_sphere(params_of(params, layer, 0), planet, rng, job);
}

}  // namespace seedmesh::terrain
