/// Patterns of places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/generators/scene/shapes.h"
#include "core/generators/scene/stands.h"

namespace seedmesh::scene {
namespace {

Job any_job(int threads = 1) {
  Job::Options options;
  options.threads = threads;
  return Job(1, options);
}

Extent square(double side) { return {glm::dvec2(-side / 2), glm::dvec2(side / 2)}; }

double least_distance(const Array<Stand>& stands, const Extent& extent, double near) {
  Neighbours places(extent, near, any_job());
  for (std::size_t i = 0; i < stands.size(); ++i) places.add(stands[i].at, static_cast<std::uint32_t>(i));
  double least = 1e30;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    places.any(stands[i].at, 2 * near, [&](std::uint32_t id, double squared) {
      if (id != i) least = std::min(least, squared);
      return false;
    });
  }
  return std::sqrt(least);
}

TEST(PoissonDisk, KeepsTheDistance) {
  for (const double distance : {0.3, 1.0, 3.7}) {
    const Extent ground = square(60);
    const Array<Stand> stands = poisson_disk(ground, ground, distance, Rng(7), any_job());
    EXPECT_GE(least_distance(stands, ground, distance), distance);
  }
}

TEST(PoissonDisk, KeepsTheDistanceWhenPlacesAreRoundedTo32Bit) {
  const Extent ground{{100'000, 100'000}, {100'020, 100'020}};
  Array<Stand> stands = poisson_disk(ground, ground, 0.5, Rng(7), any_job());
  for (Stand& stand : stands) stand.at = glm::dvec2(glm::vec2(stand.at));
  EXPECT_GE(least_distance(stands, ground, 0.5), 0.5);
}

TEST(PoissonDisk, IsNearlySaturated) {
  const Extent ground = square(200);
  const Array<Stand> stands = poisson_disk(ground, ground, 1, Rng(3), any_job());
  const double density = static_cast<double>(stands.size()) / (200.0 * 200);
  EXPECT_GT(density, 0.64);
  EXPECT_LT(density, 0.75);
  // No place on the ground is further from one than the distance, but for a few in thousand.
  Neighbours places(ground, 1, any_job());
  for (std::size_t i = 0; i < stands.size(); ++i) places.add(stands[i].at, static_cast<std::uint32_t>(i));
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
  const Array<Stand> one = poisson_disk(ground, ground, 1, Rng(3), any_job(1));
  const Array<Stand> eight = poisson_disk(ground, ground, 1, Rng(3), any_job(8));
  ASSERT_EQ(one.size(), eight.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].at, eight[i].at);
    EXPECT_EQ(one[i].key, eight[i].key);
  }
}

TEST(PoissonDisk, OfAPartIsThatOfTheWholeAwayFromItsEdge) {
  const Extent ground = square(100);
  const Extent part{{-30, -30}, {30, 30}};
  const Array<Stand> whole = poisson_disk(ground, ground, 1.5, Rng(3), any_job());
  const Array<Stand> some = poisson_disk(ground, part, 1.5, Rng(3), any_job());
  std::size_t same = 0, inner = 0;
  for (const Stand& stand : some) {
    if (std::abs(stand.at.x) > 15 || std::abs(stand.at.y) > 15) continue;
    ++inner;
    same += std::any_of(whole.begin(), whole.end(), [&](const Stand& other) { return other.at == stand.at; })
                ? 1U
                : 0U;
  }
  EXPECT_GT(inner, 200U);
  EXPECT_GT(same, inner * 9 / 10);
}

TEST(PoissonDisk, RefusesMorePlacesThanTheLimitBeforeItMakesAny) {
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
    EXPECT_EQ(job.purse()->used(), 0U);
  }
}

TEST(Scatter, ContinuesItsSeries) {
  const Array<Stand> all = scattered(square(10), {0, 100}, Rng(1), any_job());
  const Array<Stand> later = scattered(square(10), {60, 40}, Rng(1), any_job(4));
  for (std::size_t i = 0; i < later.size(); ++i) EXPECT_EQ(all[60 + i].at, later[i].at);
}

TEST(Clusters, AreDenserThanChance) {
  const Extent ground = square(100);
  const Array<Stand> stands = clustered(ground, {8, 3}, {0, 2000}, Rng(2), any_job());
  // Mean distance to the nearest other one: of 2,000 places by chance 0.5 / sqrt(density) = 1.12 m.
  Neighbours places(ground, 2, any_job());
  for (std::size_t i = 0; i < stands.size(); ++i) places.add(stands[i].at, static_cast<std::uint32_t>(i));
  double sum = 0;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    double least = 100;
    places.any(stands[i].at, 10, [&](std::uint32_t id, double squared) {
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
  const Array<Stand> stands = in_rows(square(20), plan, Rng(1), any_job());
  EXPECT_EQ(stands.size(), 11U * 5);
  for (const Stand& stand : stands) {
    EXPECT_NEAR(std::remainder(stand.at.x, 2), 0, 1e-9);
    EXPECT_NEAR(std::remainder(stand.at.y, 5), 0, 1e-9);
  }
}

TEST(Rows, AreTurnedCounterClockwiseSeenFromAbove) {
  RowPlan plan;
  plan.spacing = {1, 100};
  plan.angle = math::radians(90);
  const Array<Stand> stands = in_rows(square(10), plan, Rng(1), any_job());
  EXPECT_EQ(stands.size(), 11U);
  for (const Stand& stand : stands) EXPECT_NEAR(stand.at.x, 0, 1e-9);
}

TEST(Along, StandsAtDistancesOnBothSides) {
  const std::vector<glm::dvec2> way{{0, 0}, {10, 0}, {10, 10}};
  WayPlan plan;
  plan.distance = 2;
  plan.offset = 1.5;
  const Array<Stand> stands = along(way, plan, Rng(1), any_job());
  EXPECT_EQ(stands.size(), 20U);
  const Way line = way_of(way, 0);
  for (const Stand& stand : stands) {
    EXPECT_TRUE(line.covers(stand.at, 1.6));
  }
  plan.right = false;
  const Array<Stand> left = along(way, plan, Rng(1), any_job());
  ASSERT_EQ(left.size(), 10U);
  EXPECT_NEAR(left[0].at.y, -1.5, 1e-9);  // left of east is north
}

TEST(Footprints, TellInsideFromOutsideWhenTurned) {
  Stand stand;
  stand.at = {5, 5};
  stand.turn = static_cast<float>(math::radians(90));
  const Footprint footprint = Footprint::of(stand, {3, 1}, false);
  EXPECT_LT(footprint.outside({5, 7.5}), 0);
  EXPECT_GT(footprint.outside({7.5, 5}), 1);
  EXPECT_NEAR(footprint.outside({7, 5}), 1, 1e-6);
}

}  // namespace
}  // namespace seedmesh::scene
