#include "core/generators/terrain/profile.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/generators/terrain/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"

namespace seedmesh::terrain {
namespace {

constexpr int samples = 17, seeds = 40'000;

/// Mean products of the heights of all pairs of samples, over many seeds.
std::vector<double> covariances(double hurst, double amplitude) {
  std::vector<double> sums(samples * samples);
  for (int seed = 0; seed < seeds; ++seed) {
    const Array<float> heights = brownian_heights(samples, hurst, amplitude,
                                                  Rng::of_seed(static_cast<std::uint64_t>(seed)), any_job());
    for (int i = 0; i < samples; ++i) {
      for (int k = 0; k < samples; ++k) {
        sums[static_cast<std::size_t>(i * samples + k)] +=
            static_cast<double>(heights[static_cast<std::size_t>(i)]) *
            static_cast<double>(heights[static_cast<std::size_t>(k)]) / seeds;
      }
    }
  }
  return sums;
}

TEST(BrownianHeights, HaveTheCovariancesOfMandelbrotAndVanNess) {
  for (const double hurst : {0.2, 0.5, 0.8}) {
    const std::vector<double> measured = covariances(hurst, 3);
    for (int i = 1; i < samples; ++i) {
      for (int k = 1; k < samples; ++k) {
        const double s = i / 16.0, t = k / 16.0;
        const double expected =
            9 * (std::pow(s, 2 * hurst) + std::pow(t, 2 * hurst) - std::pow(std::abs(s - t), 2 * hurst)) / 2;
        // The standard error of a mean product is below 9 * sqrt(2 / seeds).
        EXPECT_NEAR(measured[static_cast<std::size_t>(i * samples + k)], expected,
                    5 * 9 * std::sqrt(2.0 / seeds))
            << hurst << " " << i << " " << k;
      }
    }
  }
}

TEST(BrownianHeights, BeginAtZero) { EXPECT_EQ(brownian_heights(100, 0.3, 5, Rng(1), any_job())[0], 0.0F); }

TerrainParams profile_of(TerrainAlgorithm algorithm, int resolution) {
  TerrainParams params;
  params.algorithm = algorithm;
  params.shape = TerrainShape::profile;
  params.resolution = resolution;
  params.size = 100;
  return params;
}

TEST(Profile, IsAGraphOfLinesWithTheHeightsThatDeriveLists) {
  for (const TerrainAlgorithm algorithm : {TerrainAlgorithm::brownian, TerrainAlgorithm::fbm}) {
    const TerrainParams params = profile_of(algorithm, 65);
    Job job = any_job();
    const Result<Model> model = generate(params, context_of(job));
    const Result<Json> derived = derive(params, context_of(job));
    ASSERT_TRUE(model && derived);
    const Mesh& mesh = model->meshes.at(0).primitives.at(0).mesh;
    EXPECT_EQ(mesh.topology, Topology::lines);
    EXPECT_EQ(mesh.index.size(), 128U);
    ASSERT_EQ(mesh.position.size(), 65U);
    EXPECT_EQ(mesh.position[0].x, -50.0F);
    EXPECT_EQ(mesh.position[64].x, 50.0F);
    for (std::size_t i = 0; i < 65; ++i)
      EXPECT_EQ(mesh.position[i].y, derived->at("heights")[i].get<float>());
    EXPECT_EQ(derived->at("height"), 1);
  }
}

TEST(Profile, OfNoiseIsTheMiddleRowOfItsPlane) {
  TerrainParams params = profile_of(TerrainAlgorithm::fbm, 33);
  Job job = any_job();
  const Array<float> heights = profile_heights(params, job);
  params.shape = TerrainShape::plane;
  const Result<Field> field = field_of(params, job);
  ASSERT_TRUE(field);
  for (int x = 0; x < 33; ++x) EXPECT_EQ(heights[static_cast<std::size_t>(x)], field->at(x, 16));
}

std::string first_error(const TerrainParams& params) {
  const std::vector<Issue> issues = check(params, Limits{});
  return issues.empty() ? "" : issues.front().pointer + " " + issues.front().message;
}

TEST(Profile, RefusesWhatAGraphDoesNotHave) {
  TerrainParams params = profile_of(TerrainAlgorithm::brownian, 65);
  EXPECT_EQ(first_error(params), "");
  params.hurst = 1;
  EXPECT_THAT(first_error(params), testing::StartsWith("/hurst found 1; brownian needs"));
  params = profile_of(TerrainAlgorithm::brownian, 5000);
  EXPECT_THAT(first_error(params), testing::StartsWith("/resolution found 5000"));
  params = profile_of(TerrainAlgorithm::brownian, 65);
  params.smooth = 10;
  EXPECT_THAT(first_error(params), testing::StartsWith("/smooth a profile does not have"));
  params = profile_of(TerrainAlgorithm::brownian, 65);
  params.shape = TerrainShape::plane;
  EXPECT_THAT(first_error(params),
              testing::StartsWith("/shape found \"plane\"; brownian is a motion along a line"));
  EXPECT_THAT(first_error(profile_of(TerrainAlgorithm::expression, 65)), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace seedmesh::terrain
