#include "core/generators/terrain/profile.h"

#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

constexpr double usual_hurst = 0.5;  ///< of ordinary Brownian motion

/// Covariances of steps of length 1 at the distances 0 to count - 1: half the second difference of d^2H.
std::vector<double> step_covariances(int count, double hurst) {
  std::vector<double> powers(static_cast<std::size_t>(count) + 1);
  for (std::size_t d = 1; d < powers.size(); ++d) powers[d] = math::pow(static_cast<double>(d), 2 * hurst);
  std::vector<double> covariance(static_cast<std::size_t>(count));
  for (std::size_t d = 0; d < covariance.size(); ++d)
    covariance[d] = (powers[d + 1] - 2 * powers[d] + powers[d > 0 ? d - 1 : 1]) / 2;
  return covariance;
}

}  // namespace

Array<float> brownian_heights(int count, double hurst, double amplitude, Rng rng, const Job& job) {
  Array<float> heights(job, static_cast<std::size_t>(count), 0.0F);
  const auto steps = static_cast<std::size_t>(count - 1);
  const std::vector<double> covariance = step_covariances(count - 1, hurst);
  const double unit = amplitude * math::pow(static_cast<double>(steps), -hurst);
  // Durbin and Levinson: weights of the steps before, for the mean of the next one, and its variance.
  std::vector<double> weights, before, done;
  double variance = 1, height = 0;
  for (std::size_t n = 0; n < steps; ++n) {
    if (n % 16 == 0) job.check();
    if (n > 0) {
      double rest = covariance[n];
      for (std::size_t i = 0; i + 1 < n; ++i) rest -= weights[i] * covariance[n - 1 - i];
      const double partial = rest / variance;
      before = weights;
      for (std::size_t i = 0; i + 1 < n; ++i) weights[i] -= partial * before[n - 2 - i];
      weights.push_back(partial);
      variance *= 1 - partial * partial;
    }
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += weights[i] * done[n - 1 - i];
    done.push_back(normal(rng, mean, std::sqrt(variance)));
    height += unit * done.back();
    heights[n + 1] = static_cast<float>(height);
  }
  return heights;
}

Array<float> profile_heights(const TerrainParams& params, const Job& job) {
  const Rng rng = job.rng().at("terrain");
  const int count = made_side(params);
  if (params.algorithm == TerrainAlgorithm::brownian) {
    return brownian_heights(count, params.hurst.value_or(usual_hurst), amplitude_of(params),
                            rng.at("profile"), job);
  }
  const Window row{0, (count - 1) / 2, count, 1};
  Field field = algorithm_field(params, row, params.size / (count - 1), rng, job);
  return std::move(field.heights);
}

Model profile_model(const TerrainParams& params, Job& job) {
  const Array<float> heights = profile_heights(params, job);
  job.progress("mesh", 0);
  job.spend(Resource::triangles, heights.size() - 1);
  Mesh mesh;
  mesh.topology = Topology::lines;
  mesh.position = Array<glm::vec3>(job, heights.size());
  mesh.index.wide = Array<std::uint32_t>(job);
  mesh.index.wide.reserve(2 * heights.size());
  const double cell = params.size / static_cast<double>(heights.size() - 1);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    mesh.position[i] = {static_cast<float>(cell * static_cast<double>(i) - params.size / 2), heights[i],
                        0.0F};
    if (i == 0) continue;
    mesh.index.wide.push_back(static_cast<std::uint32_t>(i) - 1);
    mesh.index.wide.push_back(static_cast<std::uint32_t>(i));
  }
  Model model;
  model.name = "terrain";
  Material material;
  material.name = "profile";
  material.base_color = {linear_of_srgb(58), linear_of_srgb(64), linear_of_srgb(72), 1};
  material.unlit = true;
  Node& root = model.nodes.emplace_back();
  root.name = "terrain";
  root.mesh = add_mesh(model, "profile", std::move(mesh), add_material(model, std::move(material)));
  return model;
}

}  // namespace seedmesh::terrain
