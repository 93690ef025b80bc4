/// Patterns of candidate positions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/generators/scene/candidate_positions.h"
#include "core/generators/scene/shapes.h"

namespace seedmesh::scene {
namespace {

Job any_job(int threads = 1) {
  Job::Options options;
  options.threads = threads;
  return Job(1, options);
}

Extent square(double side) { return {glm::dvec2(-side / 2), glm::dvec2(side / 2)}; }

double least_distance(const Array<Placement>& placements, const Extent& extent, double near) {
  Neighbours places(extent, near, any_job());
  for (std::size_t i = 0; i < placements.size(); ++i)
    places.add(placements[i].at, static_cast<std::uint32_t>(i));
  double least = 1e30;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    places.any(placements[i].at, 2 * near, [&](std::uint32_t id, double squared) {
      if (id != i) least = std::min(least, squared);
      return false;
    });
  }
  return std::sqrt(least);
}

TEST(PoissonDisk, KeepsTheDistance) {
  for (const double distance : {0.3, 1.0, 3.7}) {
    const Extent ground = square(60);
    const Array<Placement> placements = poisson_disk(ground, ground, distance, Rng(7), any_job());
    EXPECT_GE(least_distance(placements, ground, distance), distance);
  }
}

TEST(PoissonDisk, KeepsTheDistanceWhenPositionsAreRoundedTo32Bit) {
  const Extent ground{{100'000, 100'000}, {100'020, 100'020}};
  Array<Placement> placements = poisson_disk(ground, ground, 0.5, Rng(7), any_job());
  for (Placement& placement : placements) placement.at = glm::dvec2(glm::vec2(placement.at));
  EXPECT_GE(least_distance(placements, ground, 0.5), 0.5);
}

TEST(PoissonDisk, IsNearlySaturated) {
  const Extent ground = square(200);
  const Array<Placement> placements = poisson_disk(ground, ground, 1, Rng(3), any_job());
  const double density = static_cast<double>(placements.size()) / (200.0 * 200);
  EXPECT_GT(density, 0.64);
  EXPECT_LT(density, 0.75);
  // Almost every point of the ground is within the distance of a position; a few in a thousand are not.
  Neighbours places(ground, 1, any_job());
  for (std::size_t i = 0; i < placements.size(); ++i)
    places.add(placements[i].at, static_cast<std::uint32_t>(i));
  int open = 0;
  Rng rng(5);
  for (int i = 0; i < 20'000; ++i) {
    const double x = rng.uniform(-98, 98);
    const glm::dvec2 p(x, rng.uniform(-98, 98));
    open += places.any(p, 1, [](std::uint32_t, double) { return true; }) ? 0 : 1;
  }
  EXPECT_LT(open, 200);
}

TEST(PoissonDisk, DoesNotDependOnThreads) {
  const Extent ground = square(300);
  const Array<Placement> one = poisson_disk(ground, ground, 1, Rng(3), any_job(1));
  const Array<Placement> eight = poisson_disk(ground, ground, 1, Rng(3), any_job(8));
  ASSERT_EQ(one.size(), eight.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].at, eight[i].at);
    EXPECT_EQ(one[i].key, eight[i].key);
  }
}

TEST(PoissonDisk, OfAPartEqualsTheWholeAwayFromItsBorder) {
  const Extent ground = square(100);
  const Extent part{{-30, -30}, {30, 30}};
  const Array<Placement> whole = poisson_disk(ground, ground, 1.5, Rng(3), any_job());
  const Array<Placement> some = poisson_disk(ground, part, 1.5, Rng(3), any_job());
  std::size_t same = 0, inner = 0;
  for (const Placement& placement : some) {
    if (std::abs(placement.at.x) > 15 || std::abs(placement.at.y) > 15) continue;
    ++inner;
    same += std::any_of(whole.begin(), whole.end(),
                        [&](const Placement& other) { return other.at == placement.at; })
                ? 1U
                : 0U;
  }
  EXPECT_GT(inner, 200U);
  EXPECT_GT(same, inner * 9 / 10);
}

TEST(PoissonDisk, RefusesMorePositionsThanTheLimitBeforeItMakesAny) {
  Job::Options options;
  options.limits.shapes = 1000;
  options.limits.memory_bytes = 1 << 20;
  const Job job(1, options);
  const Extent ground = square(1000);
  try {
    poisson_disk(ground, ground, 0.1, Rng(1), job);
    FAIL();
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::limit);
    EXPECT_EQ(job.budget()->used(), 0U);
  }
}

TEST(Scatter, ContinuesItsSeries) {
  const Array<Placement> all = scattered(square(10), {0, 100}, Rng(1), any_job());
  const Array<Placement> later = scattered(square(10), {60, 40}, Rng(1), any_job(4));
  for (std::size_t i = 0; i < later.size(); ++i) EXPECT_EQ(all[60 + i].at, later[i].at);
}

TEST(Clusters, AreDenserThanRandomPositions) {
  const Extent ground = square(100);
  const Array<Placement> placements = clustered(ground, {8, 3}, {0, 2000}, Rng(2), any_job());
  // Mean distance to the nearest neighbour: 0.5 / sqrt(density) = 1.12 m for 2,000 random positions.
  Neighbours places(ground, 2, any_job());
  for (std::size_t i = 0; i < placements.size(); ++i)
    places.add(placements[i].at, static_cast<std::uint32_t>(i));
  double sum = 0;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    double least = 100;
    places.any(placements[i].at, 10, [&](std::uint32_t id, double squared) {
      if (id != i) least = std::min(least, squared);
      return false;
    });
    sum += std::sqrt(least);
  }
  EXPECT_LT(sum / 2000, 0.7);
}

TEST(Rows, HaveTheirSpacing) {
  RowPlan plan;
  plan.spacing = {2, 5};
  const Array<Placement> placements = in_rows(square(20), plan, Rng(1), any_job());
  EXPECT_EQ(placements.size(), 11U * 5);
  for (const Placement& placement : placements) {
    EXPECT_NEAR(std::remainder(placement.at.x, 2), 0, 1e-9);
    EXPECT_NEAR(std::remainder(placement.at.y, 5), 0, 1e-9);
  }
}

TEST(Rows, AreTurnedCounterClockwiseSeenFromAbove) {
  RowPlan plan;
  plan.spacing = {1, 100};
  plan.angle = math::radians(90);
  const Array<Placement> placements = in_rows(square(10), plan, Rng(1), any_job());
  EXPECT_EQ(placements.size(), 11U);
  for (const Placement& placement : placements) EXPECT_NEAR(placement.at.x, 0, 1e-9);
}

TEST(Along, PutsPositionsAtDistancesOnBothSides) {
  const std::vector<glm::dvec2> way{{0, 0}, {10, 0}, {10, 10}};
  PathPlan plan;
  plan.distance = 2;
  plan.offset = 1.5;
  const Array<Placement> placements = along(way, plan, Rng(1), any_job());
  EXPECT_EQ(placements.size(), 20U);
  const PathBand line = path_band_of(way, 0);
  for (const Placement& placement : placements) {
    EXPECT_TRUE(line.covers(placement.at, 1.6));
  }
  plan.right = false;
  const Array<Placement> left = along(way, plan, Rng(1), any_job());
  ASSERT_EQ(left.size(), 10U);
  EXPECT_NEAR(left[0].at.y, -1.5, 1e-9);  // left of east is north
}

TEST(Footprints, DistinguishInsideFromOutsideWhenTurned) {
  Placement placement;
  placement.at = {5, 5};
  placement.turn = static_cast<float>(math::radians(90));
  const Footprint footprint = Footprint::of(placement, {3, 1}, false);
  EXPECT_LT(footprint.outside({5, 7.5}), 0);
  EXPECT_GT(footprint.outside({7.5, 5}), 1);
  EXPECT_NEAR(footprint.outside({7, 5}), 1, 1e-6);
}

}  // namespace
}  // namespace seedmesh::scene
