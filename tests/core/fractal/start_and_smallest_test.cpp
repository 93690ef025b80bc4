/// Start points of the chaos game, and pieces that become points.
#include <cmath>
#include <set>

#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/encode.h"
#include "core/generators/fractal/pieces.h"
#include "tests/core/fractal/support.h"
#include "tests/support/context.h"

namespace seedmesh::fractal {
namespace {

TEST(ChaosGame, StartsOnTheSurfaceOfItsElement) {
  Job job(3, Job::Options{});
  const Result<StartPoints> start = start_of(fractal_params(R"({"method": "frcm"})"), context_of(job));
  ASSERT_TRUE(start);
  std::array<int, 6> sides{};
  constexpr int draws = 120'000;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const glm::dvec3 p = start->draw(Rng(i));
    int on = 0;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::abs(p[axis]), 0.5 + 1e-12);
      if (std::abs(std::abs(p[axis]) - 0.5) > 1e-12) continue;
      ++on;
      ++sides[static_cast<std::size_t>(2 * axis + (p[axis] > 0 ? 1 : 0))];
    }
    EXPECT_GE(on, 1);
  }
  // A sixth of the points on each side of the cube: 20,000, with a standard deviation of 129.
  for (const int count : sides) EXPECT_NEAR(count, draws / 6, 600);
}

TEST(ChaosGame, StartsOnTheLineOfASegmentOrInTheCube) {
  Job job(3, Job::Options{});
  const Result<StartPoints> line =
      start_of(fractal_params(R"({"method": "frcm", "element": "segment"})"), context_of(job));
  const Result<StartPoints> cube =
      start_of(fractal_params(R"({"method": "frcm", "start": "cube"})"), context_of(job));
  ASSERT_TRUE(line && cube);
  glm::dvec3 mean(0);
  double along = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const glm::dvec3 p = line->draw(Rng(i)), q = cube->draw(Rng(i));
    EXPECT_EQ(p.y, 0);
    EXPECT_EQ(p.z, 0);
    along += p.x * p.x / 100'000;
    mean += q * q / 100'000.0;
  }
  EXPECT_NEAR(along, 1.0 / 12, 0.001);  // the variance of a uniform distribution
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 1.0 / 12, 0.001);
}

TEST(SmallestPieces, BecomePointsInTheRoundThatMakesThemTooSmall) {
  // Pieces of a third: 1/9 is not below 0.1, 1/27 is.
  const Json cantor = derived(R"({"instructions": "cantor_dust", "iterations": 30, "smallest": 0.1})");
  EXPECT_EQ(cantor["pieces"], 512);
  EXPECT_EQ(cantor["points"], 512);
  const Json fewer = derived(R"({"instructions": "cantor_dust", "iterations": 2, "smallest": 0.1})");
  EXPECT_EQ(fewer["pieces"], 64);
  EXPECT_EQ(fewer["points"], 0);
  EXPECT_TRUE(derived(R"({"instructions": "cantor_dust"})")["points"].is_null());
}

/// The number of points of the Jerusalem cube by recursion over the sizes of its pieces.
double jerusalem_points(double edge, double smallest) {
  if (edge < smallest) return 1;
  const double large = std::sqrt(2.0) - 1, small = large * large;
  return 8 * jerusalem_points(edge * large, smallest) + 12 * jerusalem_points(edge * small, smallest);
}

TEST(SmallestPieces, OfMapsWithSeveralScalesEndInDifferentRounds) {
  for (const double smallest : {0.5, 0.3, 0.11, 0.05, 0.02}) {
    const Json answer = derived(R"({"instructions": "jerusalem_cube", "iterations": 100, "smallest": )" +
                                std::to_string(smallest) + "}");
    EXPECT_EQ(answer["points"].get<double>(), jerusalem_points(1, smallest)) << smallest;
  }
}

TEST(SmallestPieces, AreAMeshOfPointsBesideTheOtherPieces) {
  const Result<Model> model = fractal_of(
      R"({"instructions": [{"scale": 0.5, "translate": [-0.25, 0, 0]}, {"scale": 0.2, "translate": [0.4, 0, 0]}],
          "iterations": 2, "smallest": 0.15})");
  ASSERT_TRUE(model);
  // Scales 0.25, 0.1, 0.1 and 0.04 after two rounds: one cube and three points.
  ASSERT_EQ(model->meshes.size(), 2U);
  EXPECT_EQ(model->meshes[0].primitives[0].mesh.elements(), 12U);
  const Mesh& points = model->meshes[1].primitives[0].mesh;
  EXPECT_EQ(points.topology, Topology::points);
  ASSERT_EQ(points.position.size(), 3U);
  EXPECT_NEAR(points.position[0].x, -0.25F + 0.5F * 0.4F, 1e-6F);
  EXPECT_THAT(refusal(R"({"instructions": "menger_sponge", "iterations": 30, "smallest": 0.0001})"),
              testing::StartsWith("/smallest: needs more than 40000000"));
}

}  // namespace
}  // namespace seedmesh::fractal
