#include "core/geom/plant/graft/ring_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

TEST(RingShape, HasHalfTheCornersAtATenthOfTheRadius) {
  EXPECT_EQ(corners_by_radius(2, 2, 16), 16);
  EXPECT_EQ(corners_by_radius(0.2F, 2, 16), 8) << "16 * 0.1^0.3 = 8.02";
  EXPECT_EQ(corners_by_radius(0.0F, 2, 16), 3);
}

TEST(RingShape, FindsTheSameCornersByTableAsByPower) {
  Job job(1, Job::Options{});
  for (const int sides : {3, 5, 8, 13, 24, 64}) {
    GraftOptions options;
    options.sides = sides;
    const Limbs limbs = limb_through(job, {{0, 0, 0}, {0, 5, 0}}, 0.5F);
    const RingTables tables = ring_tables(limbs, options);
    Rng rng(2);
    for (int i = 0; i < 2000; ++i) {
      const auto radius = static_cast<float>(0.5 * rng.unit());
      EXPECT_EQ(corners_by_table(tables, options, radius), corners_by_radius(radius, 0.5F, sides))
          << sides << " at " << radius;
    }
  }
}

TEST(RingShape, HasFourCornersForEachDeepRibAndThreeForEachShallowOne) {
  GraftOptions options;
  options.lobes = 5;
  options.lobe_depth = 0.05F;
  EXPECT_EQ(ribbed_corners(options, 4), 15);
  options.lobe_depth = 0.2F;
  EXPECT_EQ(ribbed_corners(options, 4), 20);
  EXPECT_EQ(ribbed_corners(options, 22) % 5, 0);
}

TEST(RingShape, RepeatsATextureOnceForEachMetreOfCircumference) {
  EXPECT_EQ(texture_repeats(0.01F, 1), 1.0F);
  EXPECT_EQ(texture_repeats(0.5F, 1), 3.0F) << "a circumference of 3.14 m";
  EXPECT_EQ(texture_repeats(1, 1), 6.0F) << "6.28 m";
}

TEST(RingShape, ShowsStripsOfPowersOfTwoAroundThinLimbs) {
  constexpr float least = 1.0F / 32;
  EXPECT_EQ(texture_repeats(0.08F, least), 1.0F) << "0.754 repetitions are nearer to 1 than to 1/2 by ratio";
  EXPECT_EQ(texture_repeats(0.053F, least), 0.5F) << "0.4995";
  EXPECT_EQ(texture_repeats(0.0067F, least), 0.0625F) << "0.0631";
  EXPECT_EQ(texture_repeats(0.0001F, least), least);
  EXPECT_EQ(texture_repeats(0.5F, least), 5.0F) << "4.71";
  for (float radius = 0.003F; radius < 2; radius *= 1.01F) {
    const float metres = 6.2831853F * radius / texture_repeats(radius, least);
    EXPECT_GT(metres, 0.7F / 1.5F) << radius;
    EXPECT_LT(metres, 1) << radius;
  }
}

TEST(RingShape, FindsAVectorAtRightAnglesToAnyOther) {
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 along =
        glm::normalize(glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)));
    const glm::vec3 aside = unit_perpendicular(along);
    EXPECT_NEAR(glm::length(aside), 1, 1e-6);
    EXPECT_NEAR(glm::dot(aside, along), 0, 1e-6);
  }
}

}  // namespace
}  // namespace seedmesh
