#include "core/geom/plant/tropism.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

/// A frame that heads along `heading`.
Frame head_of(const glm::dvec3& heading) {
  Frame frame;
  frame.heading = heading;
  return upright(reorthonormalise(frame));
}

double angle_to(const glm::dvec3& a, const glm::dvec3& b) { return math::acos(glm::dot(a, b)); }

TEST(Tropism, TurnsByElasticityTimesTheSineOfTheAngle) {
  const Tropisms gravity({{{0, -1, 0}, 0.2, 0}});
  Frame level = head_of({1, 0, 0});
  EXPECT_NEAR(angle_to(gravity.turned(level).heading, {1, 0, 0}), 0.2, 1e-12);
  EXPECT_LT(gravity.turned(level).heading.y, 0);
  Frame slanting = turn(Frame{}, math::sincos_degrees(30));
  EXPECT_NEAR(angle_to(gravity.turned(slanting).heading, slanting.heading), 0.1, 1e-12);
}

TEST(Tropism, LeavesWhatGrowsAlongItOrAgainstIt) {
  const Tropisms light({{{0, 1, 0}, 0.5, 0}});
  EXPECT_EQ(light.turned(Frame{}).heading, (glm::dvec3{0, 1, 0}));
  EXPECT_EQ(light.turned(turn_around(Frame{})).heading, (glm::dvec3{0, -1, 0}));
}

TEST(Tropism, KeepsTheFrameAtRightAngles) {
  const Tropisms two({{{1, 2, -0.5}, 0.4, 0}, {{0, -1, 0}, 0.3, 0}});
  Frame f = pitch(turn(Frame{}, math::sincos(1)), math::sincos(0.7));
  for (int i = 0; i < 1000; ++i) f = two.turned(f);
  EXPECT_NEAR(glm::dot(f.heading, f.left), 0, 1e-12);
  EXPECT_NEAR(glm::dot(f.up, f.up), 1, 1e-12);
}

TEST(Tropism, GivesElasticityBackAtTheEndOfABranch) {
  Tropisms gravity({{{0, -1, 0}, 0.2, 0.1}});
  gravity.push();
  gravity.set(0, 1);
  gravity.change(0, -2);
  const Frame level = head_of({1, 0, 0});
  EXPECT_NEAR(angle_to(gravity.turned(level).heading, {1, 0, 0}), 0.8, 1e-12);
  gravity.pop();
  EXPECT_NEAR(angle_to(gravity.turned(level).heading, {1, 0, 0}), 0.2, 1e-12);
  gravity.pop();  // more than was pushed
  gravity.set(7, 1);
  EXPECT_NEAR(angle_to(gravity.turned(level).heading, {1, 0, 0}), 0.2, 1e-12);
}

}  // namespace
}  // namespace seedmesh
