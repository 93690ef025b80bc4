#include "core/geom/polygon/straight_skeleton.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "tests/core/geom/plans.h"

namespace seedmesh {
namespace {

using testing::SizeIs;

Job job_of() { return Job(1, Job::Options{}); }

double highest(const StraightSkeleton& skeleton) {
  double time = 0;
  for (const glm::dvec3& node : skeleton.node) time = std::max(time, node.z);
  return time;
}

/// Volume under the roof of slope 1.
double volume(const StraightSkeleton& skeleton) {
  double sum = 0;
  for (const SkeletonFace& face : skeleton.faces) {
    const glm::dvec3 a = skeleton.node[face.outline[0]];
    for (std::size_t i = 1; i + 1 < face.outline.size(); ++i) {
      const glm::dvec3 b = skeleton.node[face.outline[i]], c = skeleton.node[face.outline[i + 1]];
      sum += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) * (a.z + b.z + c.z) / 6;
    }
  }
  return sum;
}

struct Known {
  const char* name;
  PlanRing ring;
  double height, volume;
  std::size_t faces, inner;
};

TEST(StraightSkeleton, AgreesWithKnownRoofs) {
  const std::vector<Known> all{
      {"square", {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 5, 166.666667, 4, 1},
      {"L", {{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}, 2.5, 83.333333, 6, 3},
      {"dormer",
       {{0, 0}, {20, 0}, {20, 10}, {12, 10}, {12, 12}, {8, 12}, {8, 10}, {0, 10}},
       5,
       424.666667,
       8,
       5},
      {"collinear", {{0, 0}, {5, 0}, {10, 0}, {10, 6}, {5, 6}, {0, 6}}, 3, 72, 6, 3},
      {"3-4-5", {{0, 0}, {4, 0}, {0, 3}}, 1, 2, 3, 1},
      {"crash",
       {{7481, 274},
        {10509, 115},
        {10555, 964},
        {7481, 1126},
        {7481, 1866},
        {4356, 1866},
        {4356, -1896},
        {7481, -1896}},
       1562.5,
       -1,
       8,
       5}};
  for (const Known& known : all) {
    const Plan plan = plan_of(known.ring);
    const StraightSkeleton skeleton = straight_skeleton(plan, {}, job_of());
    ASSERT_TRUE(skeleton.is_sound) << known.name;
    EXPECT_THAT(skeleton.faces, SizeIs(known.faces)) << known.name;
    EXPECT_NEAR(highest(skeleton), known.height, 1e-6 * known.height) << known.name;
    if (known.volume > 0) {
      EXPECT_NEAR(volume(skeleton), known.volume, 1e-5) << known.name;
    }
    std::vector<bool> is_used(skeleton.node.size(), false);
    for (const SkeletonFace& face : skeleton.faces)
      for (const std::uint32_t node : face.outline) is_used[node] = true;
    EXPECT_EQ(static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), true)),
              known.inner + known.ring.size())
        << known.name;
  }
}

/// The same rectangle with a further corner in its first edge takes the general way.
TEST(StraightSkeleton, OfARectangleIsThatOfTheGeneralMethod) {
  const Job job = job_of();
  Rng draw(11);
  for (int n = 0; n < 20'000; ++n) {
    const double width = draw.uniform(1, 40), depth = draw.uniform(1, 40), speed = draw.uniform(0.2, 3);
    const math::SinCos turn = math::sincos_degrees(90.0 * draw.below(4));
    const auto corner = [&](double x, double y) {
      return glm::dvec2(x * turn.cos - y * turn.sin, x * turn.sin + y * turn.cos);
    };
    const glm::dvec2 a = corner(-width / 2, -depth / 2), b = corner(width / 2, -depth / 2),
                     c = corner(width / 2, depth / 2), d = corner(-width / 2, depth / 2);
    const double side = n % 3 == 0 ? 0 : speed, front = n % 3 == 1 ? 0 : speed * draw.uniform(0.5, 2);
    if (side == 0 && front == 0) continue;
    const std::vector<double> four = {front, side, front, side}, five = {front, front, side, front, side};
    const StraightSkeleton fast = straight_skeleton(Plan{{{a, b, c, d}}}, {four}, job);
    const StraightSkeleton full = straight_skeleton(Plan{{{a, (a + b) / 2.0, b, c, d}}}, {five}, job);
    ASSERT_TRUE(fast.is_sound && full.is_sound) << width << " x " << depth;
    EXPECT_NEAR(highest(fast), highest(full), 1e-9 * highest(full));
    EXPECT_NEAR(volume(fast), volume(full), 1e-9 * volume(full));
    for (const glm::dvec3& node : fast.node) {
      const auto is_same = [&](const glm::dvec3& other) { return glm::length(node - other) < 1e-8; };
      EXPECT_TRUE(std::any_of(full.node.begin(), full.node.end(), is_same)) << width << " x " << depth;
    }
  }
}

TEST(StraightSkeleton, RunsRoundACourtyard) {
  const Plan plan = plan_of({{0, 0}, {12, 0}, {12, 12}, {0, 12}}, {{{4, 4}, {8, 4}, {8, 8}, {4, 8}}});
  const StraightSkeleton skeleton = straight_skeleton(plan, {}, job_of());
  ASSERT_TRUE(skeleton.is_sound);
  EXPECT_THAT(skeleton.faces, SizeIs(8));
  EXPECT_NEAR(highest(skeleton), 2, 1e-9);
  EXPECT_NEAR(volume(skeleton), 128, 1e-9);
}

TEST(StraightSkeleton, KeepsAnEdgeOfSpeedZeroVertical) {
  const std::vector<double> speed{1, 0, 1, 0};
  const StraightSkeleton skeleton = straight_skeleton(rectangle(10, 6), {speed}, job_of());
  ASSERT_TRUE(skeleton.is_sound);
  ASSERT_THAT(skeleton.faces, SizeIs(4));
  EXPECT_THAT(skeleton.faces[1].outline, SizeIs(3));
  EXPECT_THAT(skeleton.faces[0].outline, SizeIs(4));
  for (const std::uint32_t node : skeleton.faces[1].outline) EXPECT_NEAR(skeleton.node[node].x, 10, 1e-9);
  EXPECT_NEAR(highest(skeleton), 3, 1e-9);
}

TEST(StraightSkeleton, MakesAStepWhereOneLineHasTwoSpeeds) {
  const Plan plan = plan_of({{0, 0}, {5, 0}, {10, 0}, {10, 6}, {0, 6}});
  const std::vector<double> speed{1, 2, 1, 1, 1};
  const StraightSkeleton skeleton = straight_skeleton(plan, {speed}, job_of());
  ASSERT_TRUE(skeleton.is_sound);
  const auto step = std::find_if(skeleton.faces.begin(), skeleton.faces.end(),
                                 [](const SkeletonFace& face) { return face.is_step; });
  ASSERT_NE(step, skeleton.faces.end());
  EXPECT_EQ(step->edge, 1U);
}

TEST(StraightSkeleton, DoesNotEndWithoutMotion) {
  const std::vector<double> speed(4, 0.0);
  EXPECT_FALSE(straight_skeleton(rectangle(3, 2), {speed}, job_of()).is_sound);
}

/// Heights of nodes are the distance to the line of the edge over its speed; neighbours share their nodes;
/// the areas add up (is_sound).
void expect_sound(const Plan& plan, std::span<const double> speed, std::uint64_t seed) {
  const StraightSkeleton skeleton = straight_skeleton(plan, {speed}, job_of());
  ASSERT_TRUE(skeleton.is_sound) << seed;
  double sum = 0;
  const double scale = diagonal_of(plan);
  for (const SkeletonFace& face : skeleton.faces) {
    PlanRing ring;
    const auto [a, b] = edge_of(plan, face.edge);
    const glm::dvec2 along = (b - a) / glm::length(b - a), normal{-along.y, along.x};
    for (const std::uint32_t node : face.outline) {
      const glm::dvec3 p = skeleton.node[node];
      ring.emplace_back(p);
      if (face.is_step) continue;
      const double reach = p.z * (speed.empty() ? 1 : speed[face.edge]);
      EXPECT_NEAR(glm::dot(normal, glm::dvec2(p) - a), reach, 1e-6 * scale) << seed;
    }
    sum += signed_area(ring);
    for (const auto& hole : face.holes) {
      PlanRing inner;
      for (const std::uint32_t node : hole) inner.emplace_back(skeleton.node[node]);
      sum += signed_area(inner);
    }
  }
  EXPECT_NEAR(sum, area(plan), 1e-6 * scale * scale) << seed;
}

TEST(StraightSkeleton, IsValidForTenThousandRandomPlans) {
  Rng rng(11);
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    Rng here = rng.at(seed);
    const Plan plan = seed % 2
                          ? random_star(here, 3 + static_cast<std::uint32_t>(seed / 2 % 24), seed % 4 == 1)
                          : random_blocks(here, 2 + static_cast<int>(seed / 2 % 8));
    expect_sound(plan, {}, seed);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Where edges of one line differ in speed, some plans have areas that no wavefront reaches. These are reported.
TEST(StraightSkeleton, IsValidForAnySpeedsOrReportsThatItIsNot) {
  Rng rng(12);
  int unsound = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    Rng here = rng.at(seed);
    const Plan plan = seed % 2
                          ? random_star(here, 3 + static_cast<std::uint32_t>(seed / 2 % 24), seed % 4 == 1)
                          : random_blocks(here, 2 + static_cast<int>(seed / 2 % 8));
    std::vector<double> speed;
    for (std::uint32_t i = 0; i < edge_count(plan); ++i)
      speed.push_back(seed % 3 ? here.uniform(0.5, 2) : 0.5 * (1 + here.below(3)));
    if (straight_skeleton(plan, {speed}, job_of()).is_sound) {
      expect_sound(plan, speed, seed);
    } else {
      EXPECT_EQ(seed % 2, 0U) << "a star has no two edges of one line: " << seed;
      ++unsound;
    }
  }
  EXPECT_LT(unsound, 20);
}

TEST(StraightSkeleton, MeetsAThousandCorners) {
  const StraightSkeleton skeleton = straight_skeleton(random_star(Rng(4), 1000, false), {}, job_of());
  EXPECT_TRUE(skeleton.is_sound);
}

/// A ring whose radius alternates between two values that vary by a share.
Plan long_star(std::uint32_t count, double inner, double share) {
  PlanRing ring;
  Rng rng(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * i / count);
    const double radius = (i % 2 == 0 ? 20 : inner) * (1 + rng.uniform(-share, share));
    ring.emplace_back(radius * at.cos, radius * at.sin);
  }
  return plan_of(ring);
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(StraightSkeleton, OfThousandsOfPointsCoversThePlanInAFewSteps) {
  const Job job = job_of();
  // All events of a regular star are in its centre, at times that differ by rounding errors alone.
  for (const auto& [inner, share] : {std::pair{1.0, 0.0},
                                     {10.0, 0.0},
                                     {19.9, 0.0},
                                     {19.95, 0.0},
                                     {19.99, 0.0},
                                     {19.999, 0.0},
                                     {20.0, 0.0},
                                     {10.0, 0.1},
                                     {19.0, 0.01},
                                     {19.99, 1e-9},
                                     {19.99, 1e-7}}) {
    const Plan plan = long_star(5000, inner, share);
    const double begun = cpu_seconds();
    const StraightSkeleton skeleton = straight_skeleton(plan, {}, job);
    // 26 s for 19.99 where all pairs of an edge and a corner are events.
    EXPECT_LT(cpu_seconds() - begun, 2) << inner << " " << share;
    ASSERT_TRUE(skeleton.is_sound) << inner << " " << share;
    double covered = 0;
    for (const SkeletonFace& face : skeleton.faces) {
      PlanRing ring;
      for (const std::uint32_t node : face.outline) ring.emplace_back(skeleton.node[node]);
      covered += signed_area(ring);
    }
    EXPECT_NEAR(covered, area(plan), 1e-6 * area(plan)) << inner << " " << share;
  }
}

TEST(StraightSkeleton, EndsSoonAfterItsDeadline) {
  for (const double share : {0.0, 0.1}) {
    const Plan plan = long_star(5000, 10, share);
    for (const int milliseconds : {0, 5, 50}) {
      Job::Options options;
      options.deadline = Job::Clock::now() + std::chrono::milliseconds(milliseconds);
      const Job job(1, options);
      const double begun = cpu_seconds();
      EXPECT_THROW(straight_skeleton(plan, {}, job), Stop) << milliseconds;
      EXPECT_LT(cpu_seconds() - begun, 0.001 * milliseconds + 0.05) << milliseconds;
    }
  }
}

}  // namespace
}  // namespace seedmesh
