/// Section 4.8 of Weber and Penn: stems in the wind.
#include "core/generators/tree/sway.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

TreeParams in_wind(double wind, double gust = 0, double time = 0) {
  TreeParams params;
  params.sway.wind = wind;
  params.sway.gust = gust;
  params.sway.time = time;
  return params;
}

TEST(Sway, TurnsASegmentByTheFormulaOfThePaper) {
  TreeSway sway;
  sway.wind = 10;
  sway.gust = 5;
  sway.time = 30;
  SwayingStem stem;
  stem.length = 2;
  stem.base_radius = 0.2;
  stem.segments = 4;
  stem.offset_x = 0.3;
  stem.offset_y = 1.1;
  const double a0 = 4 * 2 * (1 - 0.25) / 0.5, a1 = a0 * 10 / 50, a2 = a0 * 5 / 50 + a1 / 2;
  const SwayAngles angles = sway_angles(sway, stem, 0.25, 0.5);
  const double passed = 0.2 / 2 * 30 / 15;
  EXPECT_NEAR(angles.x, (a1 * std::sin(0.3 + passed) + a2 * std::sin(0.7 * (0.3 + passed))) / 4, 1e-12);
  EXPECT_NEAR(angles.y, (a1 * std::sin(1.1 + passed) + a2 * std::sin(0.7 * (1.1 + passed))) / 4, 1e-12);
}

TEST(Sway, NeverTurnsAStemByMoreThanARightAngle) {
  TreeSway sway;
  sway.wind = 50;
  SwayingStem thread;
  thread.length = 10;
  thread.offset_x = 1.5;
  EXPECT_LE(std::abs(sway_angles(sway, thread, 0, 0).x), 90);
}

TEST(Sway, BendsStemsAndLeavesTheirLengthsAlone) {
  const Skeletons still(in_wind(0), 7), bent(in_wind(6, 3), 7);
  const Limbs &a = still.limbs(), &b = bent.limbs();
  ASSERT_EQ(a.size(), b.size());
  float farthest = 0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    ASSERT_EQ(a.parent[i], b.parent[i]);
    EXPECT_NEAR(glm::distance(a.position[i], a.position[a.parent[i]]),
                glm::distance(b.position[i], b.position[b.parent[i]]), 1e-4F);
    farthest = std::max(farthest, glm::distance(a.position[i], b.position[i]));
  }
  EXPECT_GT(farthest, 0.3F);
  EXPECT_EQ(still.organs().organ.size(), bent.organs().organ.size());
}

TEST(Sway, MovesSmoothlyInTime) {
  const Skeletons one(in_wind(6, 3, 100), 7), next(in_wind(6, 3, 100.5), 7), later(in_wind(6, 3, 400), 7);
  float step = 0, far = 0;
  for (std::size_t i = 0; i < one.limbs().size(); ++i) {
    step = std::max(step, glm::distance(one.limbs().position[i], next.limbs().position[i]));
    far = std::max(far, glm::distance(one.limbs().position[i], later.limbs().position[i]));
  }
  EXPECT_GT(step, 0.0F);
  EXPECT_LT(step, 0.1F);
  EXPECT_GT(far, step);
}

TEST(Sway, IsZeroWithoutWindAtAnyTime) {
  const Skeletons one(in_wind(0, 0, 0), 7), other(in_wind(0, 0, 500), 7);
  EXPECT_EQ(one.tips(), other.tips());
}

}  // namespace
}  // namespace seedmesh::tree
