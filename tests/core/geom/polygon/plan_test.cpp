#include "core/geom/polygon/plan.h"

#include <gmock/gmock.h>

#include "core/base/rng.h"
#include "tests/core/geom/plans.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Job job_of() { return Job(1, Job::Options{}); }

TEST(Plan, IsReadInAnyDirectionAndClosedOrNot) {
  const Plan plan = read_plan({{{0, 0}, {0, 4}, {4, 4}, {4, 0}, {0, 0}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
  EXPECT_THAT(plan.rings[0], SizeIs(4));
  EXPECT_THAT(defects_of(plan), IsEmpty());
  EXPECT_NEAR(area(plan), 16 - 1, 1e-12);
  EXPECT_LT(signed_area(plan.rings[1]), 0);
}

TEST(Plan, ReportsWhichEdgesCross) {
  const auto faults = defects_of(Plan{{{{0, 0}, {4, 4}, {4, 0}, {0, 3}}}});
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].vertex, 2U);
  EXPECT_THAT(faults[0].message, HasSubstr("point 0 of ring 0"));
}

TEST(Plan, ReportsEveryErrorOfItsRings) {
  EXPECT_THAT(defects_of(Plan{}), SizeIs(1));
  EXPECT_THAT(defects_of(Plan{{{{0, 0}, {1, 0}}}}), SizeIs(1));
  EXPECT_THAT(defects_of(Plan{{{{0, 0}, {1, 0}, {2, 0}}}})[0].message, HasSubstr("no area"));
  EXPECT_THAT(defects_of(Plan{{{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}})[0].message, HasSubstr("repeats"));
  EXPECT_THAT(defects_of(Plan{{{{0, 0}, {NAN, 0}, {INFINITY, 1}}}}), SizeIs(2));
}

TEST(Plan, RefusesEdgesThatTouchAndSpikes) {
  EXPECT_THAT(defects_of(plan_of({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}})), SizeIs(2));
  EXPECT_THAT(defects_of(plan_of({{0, 0}, {4, 0}, {4, 4}, {4, 2}, {0, 4}})), testing::Not(IsEmpty()));
}

TEST(Plan, RefusesHolesOutsideAndInHoles) {
  const PlanRing outer{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  EXPECT_THAT(defects_of(plan_of(outer, {{{20, 1}, {21, 1}, {20, 2}}}))[0].message, HasSubstr("outside"));
  EXPECT_THAT(
      defects_of(plan_of(outer, {{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {{2, 2}, {3, 2}, {2, 3}}}))[0].message,
      HasSubstr("inside of the hole of ring 1"));
}

TEST(Plan, IsTriangulatedWithAllItsPoints) {
  Rng rng(3);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Plan plan = seed % 2 ? random_star(rng.at(seed), 3 + static_cast<std::uint32_t>(seed % 20), true)
                               : random_blocks(rng.at(seed), 3 + static_cast<int>(seed % 6));
    ASSERT_THAT(defects_of(plan), IsEmpty()) << seed;
    PlanRing points;
    for (const PlanRing& ring : plan.rings) points.insert(points.end(), ring.begin(), ring.end());
    std::vector<bool> is_used(points.size(), false);
    double sum = 0;
    const std::vector<std::uint32_t> triangles = triangulate(plan);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const PlanRing triangle{points[triangles[t]], points[triangles[t + 1]], points[triangles[t + 2]]};
      EXPECT_GT(signed_area(triangle), 0) << seed;
      sum += signed_area(triangle);
      for (std::size_t k = 0; k < 3; ++k) is_used[triangles[t + k]] = true;
    }
    EXPECT_NEAR(sum, area(plan), 1e-9 * area(plan)) << seed;
    EXPECT_THAT(is_used, testing::Each(true)) << seed;
  }
}

TEST(PlanOffset, MovesARectangleInAndOut) {
  const Job job = job_of();
  const auto in = offset(rectangle(10, 6), -1, job);
  ASSERT_THAT(in, SizeIs(1));
  EXPECT_NEAR(area(in[0].plan), 8 * 4, 1e-9);
  EXPECT_THAT(in[0].source, testing::UnorderedElementsAre(0U, 1U, 2U, 3U));
  const auto out = offset(rectangle(10, 6), 1, job);
  ASSERT_THAT(out, SizeIs(1));
  EXPECT_NEAR(area(out[0].plan), 12 * 8, 1e-9);
  EXPECT_THAT(offset(rectangle(10, 6), -3, job), IsEmpty());
}

TEST(PlanOffset, KeepsTheEdgeThatEachEdgeCameOf) {
  const Job job = job_of();
  const Plan plan = plan_of({{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}, {{{1, 1}, {2, 1}, {2, 2}}});
  for (const double distance : {-0.3, 0.2, 1.5}) {
    for (const DerivedPlan& moved : offset(plan, distance, job)) {
      for (std::uint32_t i = 0; i < moved.source.size(); ++i) {
        const auto [a, b] = edge_of(moved.plan, i);
        const auto [c, d] = edge_of(plan, moved.source[i]);
        const glm::dvec2 along = (d - c) / glm::length(d - c), normal{-along.y, along.x};
        EXPECT_NEAR(glm::dot(normal, a - c), -distance, 1e-9);
        EXPECT_GT(glm::dot(along, b - a), 0);
      }
    }
  }
}

TEST(PlanOffset, FallsApartWhereAPlanIsNarrow) {
  const Job job = job_of();
  const Plan dumbbell = plan_of({{0, 0},
                                 {4, 0},
                                 {4, 1.5},
                                 {8, 1.5},
                                 {8, 0},
                                 {12, 0},
                                 {12, 4},
                                 {8, 4},
                                 {8, 2.5},
                                 {4, 2.5},
                                 {4, 4},
                                 {0, 4}});
  const auto parts = offset(dumbbell, -1, job);
  ASSERT_THAT(parts, SizeIs(2));
  EXPECT_NEAR(area(parts[0].plan), 4, 1e-9);
}

TEST(PlanOffset, SetsEdgesBackByTheirOwnDistance) {
  const Job job = job_of();
  const std::vector<double> distances{2, 0, 1, 0.5};
  const Setback result = setback(rectangle(10, 8), distances, job);
  ASSERT_THAT(result.remainder, SizeIs(1));
  EXPECT_NEAR(area(result.remainder[0].plan), 9.5 * 5, 1e-9);
  double strips = 0;
  for (const PlanStrip& strip : result.strips) strips += area(strip.plan);
  EXPECT_NEAR(strips, 80 - 9.5 * 5, 1e-9);
  EXPECT_THAT(result.strips, SizeIs(3));
}

TEST(PlanOffset, FillsRandomPlans) {
  const Job job = job_of();
  Rng rng(5);
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Rng here = rng.at(seed);
    const Plan plan = seed % 2 ? random_star(here, 3 + static_cast<std::uint32_t>(seed % 17), true)
                               : random_blocks(here, 3 + static_cast<int>(seed % 5));
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < edge_count(plan); ++i) distances.push_back(here.uniform(0, 1.2));
    const Setback result = setback(plan, distances, job);
    double sum = 0;
    for (const auto& part : result.remainder) sum += area(part.plan);
    for (const auto& strip : result.strips) sum += area(strip.plan);
    EXPECT_NEAR(sum, area(plan), 1e-5 * area(plan)) << seed;
    EXPECT_THAT(result.strips, testing::Not(IsEmpty())) << seed;
  }
}

}  // namespace
}  // namespace seedmesh
