#include "core/geom/plant/frame.h"

#include <gmock/gmock.h>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

const math::SinCos right_angle = math::sincos_degrees(90);

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

void expect_same(const Frame& a, const Frame& b) {
  EXPECT_LT(distance(a.heading, b.heading), 1e-12);
  EXPECT_LT(distance(a.left, b.left), 1e-12);
  EXPECT_LT(distance(a.up, b.up), 1e-12);
}

TEST(Frame, HeadsUpWithLeftAtMinusXAndUpTowardTheViewer) {
  const Frame f;
  EXPECT_EQ(glm::cross(f.heading, f.left), f.up);
}

TEST(Frame, TurnsByTheSignsOfCpfg) {
  const Frame f;
  expect_same(turn(f, right_angle), {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}});
  expect_same(pitch(f, right_angle), {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}});
  expect_same(roll(f, right_angle), {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  expect_same(turn_around(f), {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}});
}

TEST(Frame, KeepsItsHandThroughEveryRotation) {
  Rng rng(1);
  Frame f;
  for (int i = 0; i < 1000; ++i) {
    const math::SinCos angle = math::sincos(rng.uniform(-4, 4));
    switch (rng.below(4)) {
      case 0:
        f = turn(f, angle);
        break;
      case 1:
        f = pitch(f, angle);
        break;
      case 2:
        f = roll(f, angle);
        break;
      default:
        f = turn_around(f);
        break;
    }
    EXPECT_LT(distance(glm::cross(f.heading, f.left), f.up), 1e-12);
  }
}

TEST(Frame, ComesHomeExactlyAfterFourRightAngles) {
  Frame f;
  for (int i = 0; i < 4; ++i) f = turn(f, right_angle);
  EXPECT_EQ(f.heading, Frame{}.heading);
  EXPECT_EQ(f.left, Frame{}.left);
}

TEST(Frame, UprightMakesLeftHorizontalAndUpLookUpward) {
  const Frame f = upright(roll(pitch(Frame{}, math::sincos(1.2)), math::sincos(2.3)));
  EXPECT_NEAR(f.left.y, 0, 1e-15);
  EXPECT_GT(f.up.y, 0);
  expect_same(upright(Frame{}), Frame{});
}

TEST(Frame, QuaternionTakesTheAxesToTheFrame) {
  Rng rng(2);
  Frame f;
  for (int i = 0; i < 500; ++i) {
    const glm::quat q = quaternion(f);
    EXPECT_NEAR(glm::length(q), 1, 1e-6);
    EXPECT_LT(distance(glm::dvec3(q * glm::vec3{0, 1, 0}), f.heading), 1e-6);
    EXPECT_LT(distance(glm::dvec3(q * glm::vec3{-1, 0, 0}), f.left), 1e-6);
    EXPECT_LT(distance(glm::dvec3(q * glm::vec3{0, 0, 1}), f.up), 1e-6);
    f = roll(turn(i % 5 == 0 ? turn_around(f) : f, math::sincos(rng.uniform(-4, 4))),
             math::sincos(rng.uniform(-4, 4)));
  }
}

TEST(Frame, ReorthonormaliseTakesOutSmallErrorsOnly) {
  Frame f = roll(turn(Frame{}, math::sincos(0.7)), math::sincos(0.3));
  Frame bent = f;
  bent.left += glm::dvec3{1e-6, -2e-6, 1e-6};
  bent.heading *= 1.00001;
  const Frame g = reorthonormalise(bent);
  EXPECT_NEAR(glm::dot(g.heading, g.left), 0, 1e-15);
  EXPECT_NEAR(glm::length(g.heading), 1, 1e-15);
  EXPECT_LT(distance(g.left, f.left), 1e-5);
}

}  // namespace
}  // namespace seedmesh
