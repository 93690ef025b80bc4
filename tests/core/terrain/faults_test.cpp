#include "core/generators/terrain/faults.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/generators/terrain/planet.h"
#include "tests/core/terrain/support.h"

namespace seedmesh::terrain {
namespace {

Field made(const FaultPlan& plan, const Window& window, std::uint64_t seed = 5, int threads = 1) {
  return faulted(plan, {0, 0, 65, 65}, window, 1, Rng(seed), any_job(threads));
}
constexpr Window whole{0, 0, 65, 65};

double sum_of_bounds(const FaultPlan& plan) {
  double sum = 0;
  for (int i = 0; i < plan.planned; ++i) sum += fault_bound(plan.greatest, plan.least, i, plan.planned);
  return sum + plan.extra * plan.greatest;
}

TEST(FaultFormation, LowersItsBoundByTheFormulaOfTheThesis) {
  EXPECT_DOUBLE_EQ(fault_bound(100, 1, 0, 12), 100);
  EXPECT_DOUBLE_EQ(fault_bound(100, 1, 11, 12), 9.25);
  EXPECT_DOUBLE_EQ(sum_of_bounds({.planned = 12, .greatest = 100, .least = 1}), 655.5);
  EXPECT_DOUBLE_EQ(sum_of_bounds({.planned = 32, .greatest = 40, .least = 0}), 660);
}

TEST(FaultFormation, NeverPassesTheSumOfItsBounds) {
  for (const FaultStep step : {FaultStep::hard, FaultStep::line, FaultStep::cosine}) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const FaultPlan plan{.planned = 12, .extra = 3, .greatest = 100, .least = 1, .step = step, .width = 8};
      const Field field = made(plan, whole, seed);
      const Range range = range_of(field, any_job());
      ASSERT_GE(range.low, 0.0F);
      ASSERT_LE(static_cast<double>(range.high), sum_of_bounds(plan));
    }
  }
}

TEST(FaultFormation, LiftsOneSideOfALineByOneHeight) {
  const FaultPlan plan{.planned = 1, .greatest = 10, .least = 10};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::vector<double> heights = values(made(plan, whole, seed));
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    ASSERT_LE(heights.size(), 2U);
    ASSERT_LE(heights.back(), 10.0);
  }
}

TEST(FaultFormation, SlopesBetweenTheSidesWhereItsStepIsNotHard) {
  for (const FaultStep step : {FaultStep::line, FaultStep::cosine}) {
    const FaultPlan plan{.planned = 1, .greatest = 10, .least = 10, .step = step, .width = 16};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Field field = made(plan, whole, seed);
      for (int z = 0; z < 65; ++z) {
        // A slope of 10 over 16 samples; a cosine is steeper by pi / 2 in its middle.
        for (int x = 1; x < 65; ++x) ASSERT_LE(std::abs(field.at(x, z) - field.at(x - 1, z)), 1.0F);
      }
    }
  }
}

TEST(FaultFormation, AddsExtraFaultsToThePlannedField) {
  FaultPlan plan{.planned = 8, .greatest = 10, .least = 1};
  const Field planned = made(plan, whole);
  plan.extra = 1;
  const Field more = made(plan, whole);
  for (int z = 0; z < 65; ++z) {
    for (int x = 0; x < 65; ++x) {
      ASSERT_GE(more.at(x, z), planned.at(x, z));
      ASSERT_LE(more.at(x, z), planned.at(x, z) + 10.0F);
    }
  }
}

TEST(FaultFormation, AgreesBetweenWindowsToTheBit) {
  for (const FaultStep step : {FaultStep::hard, FaultStep::line, FaultStep::cosine}) {
    for (const FaultKind kind : {FaultKind::one_sided, FaultKind::normal}) {
      const FaultPlan plan{.kind = kind, .planned = 40, .greatest = 7, .least = 1, .step = step, .width = 9};
      const Field all = made(plan, whole);
      const Field part = made(plan, {21, 13, 30, 40});
      for (int z = 0; z < 40; ++z) {
        for (int x = 0; x < 30; ++x) ASSERT_EQ(part.at(x, z), all.at(x + 21, z + 13));
      }
    }
  }
}

TEST(PoissonFaulting, LiftsOneHalfOfASphereAndSinksTheOther) {
  const Job job = any_job();
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Planet planet = sphere_of(17, 100, job);
    fault_sphere(planet, {.kind = FaultKind::normal, .planned = 1, .greatest = 4, .least = 4}, Rng(seed),
                 job);
    const auto up = std::count_if(planet.height.begin(), planet.height.end(), [](float h) { return h > 0; });
    EXPECT_NEAR(static_cast<double>(up) / static_cast<double>(planet.height.size()), 0.5, 0.03);
    const Range range = range_of(planet);
    EXPECT_EQ(range.low, -range.high);
    for (const float h : planet.height) sum += static_cast<double>(h);
  }
  EXPECT_NEAR(sum / (30 * 1538), 0, 0.1);
}

TEST(FaultFormation, LiftsOneHalfOfASphere) {
  const Job job = any_job();
  const FaultPlan one{.kind = FaultKind::one_sided, .planned = 1, .greatest = 4, .least = 4};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Planet planet = sphere_of(17, 100, job);
    fault_sphere(planet, one, Rng(seed), job);
    const auto height = static_cast<float>(fault_height(one, 0, Rng(seed)));
    const auto raised = std::count(planet.height.begin(), planet.height.end(), height);
    EXPECT_EQ(raised + std::count(planet.height.begin(), planet.height.end(), 0.0F), 1538);
    EXPECT_NEAR(static_cast<double>(raised) / 1538, 0.5, 0.03);
  }
  // Half of the sum of all faults is the mean: every fault raises half of the sphere.
  FaultPlan many = one;
  many.planned = 200;
  Planet planet = sphere_of(33, 100, job);
  fault_sphere(planet, many, Rng(1), job);
  double sum = 0, mean = 0;
  for (int i = 0; i < many.planned; ++i) sum += fault_height(many, i, Rng(1));
  for (const float h : planet.height)
    mean += static_cast<double>(h) / static_cast<double>(planet.height.size());
  EXPECT_NEAR(mean, sum / 2, 0.02 * sum);
}

TEST(Planet, HasEveryPointOfTheCubeExactlyOnce) {
  const Planet planet = sphere_of(9, 1, any_job());
  EXPECT_EQ(planet.direction.size(), 6U * 8 * 8 + 2);
  std::vector<std::array<float, 3>> points;
  for (const glm::vec3& d : planet.direction) {
    EXPECT_NEAR(glm::dot(d, d), 1.0F, 1e-6F);
    points.push_back({d.x, d.y, d.z});
  }
  std::sort(points.begin(), points.end());
  EXPECT_EQ(std::adjacent_find(points.begin(), points.end()), points.end());
}

}  // namespace
}  // namespace seedmesh::terrain
