#include "core/geom/plant/graft/junction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geom/plant/graft/ring_plan.h"
#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

/// The axis of a limb through the points, all of one radius.
LimbAxis axis_through(const std::vector<glm::vec3>& points, float radius) {
  Job job(1, Job::Options{});
  const Limbs limbs = limb_through(job, points, radius);
  LimbAxis axis;
  EXPECT_TRUE(axis.read(limbs, link_chains(limbs, job), 0, 1e-5F));
  axis.set_frames(unit_perpendicular(axis.along[0]));
  axis.set_v(0);
  return axis;
}

ChildLimb child_of(double degrees_off_y, float radius, LoopAngles& angles) {
  const math::SinCos at = math::sincos_degrees(degrees_off_y);
  ChildLimb child;
  child.along = glm::vec3(at.sin, at.cos, 0);
  child.radius = radius;
  child.length = child.tip = 3;
  child.sides = 8;
  child.angles = &angles;
  return child;
}

std::vector<LoopPoint> all_points(const Junction& junction, const std::vector<LoopPoint>& list) {
  std::vector<LoopPoint> all{junction.first, junction.last};
  all.insert(all.end(), list.begin(), list.end());
  return all;
}

TEST(LimbAxis, KeepsTheNormalOfAPlaneThatTheLimbLiesIn) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 40; ++i) {
    const math::SinCos at = math::sincos(0.1 * i);
    points.emplace_back(at.cos, at.sin, 0);
  }
  LimbAxis axis = axis_through(points, 0.1F);
  axis.set_frames({0, 0, 1});
  // A rotation-minimising frame does not turn about the tangent: the binormal of a plane curve stays.
  for (std::size_t i = 0; i < axis.pieces(); ++i) EXPECT_NEAR(axis.u[i].z, 1, 1e-6);
  EXPECT_NEAR(axis.length(), 39 * 2 * math::sin(0.05), 1e-5);
}

TEST(LimbAxis, HasFramesOfUnitVectorsAtRightAngles) {
  Rng rng(3);
  std::vector<glm::vec3> points{{0, 0, 0}};
  for (int i = 0; i < 200; ++i)
    points.push_back(points.back() + glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)));
  const LimbAxis axis = axis_through(points, 0.01F);
  for (std::size_t i = 0; i < axis.pieces(); ++i) {
    EXPECT_NEAR(glm::length(axis.u[i]), 1, 2e-6);
    EXPECT_NEAR(glm::dot(axis.u[i], axis.along[i]), 0, 2e-6);
  }
}

TEST(Junction, OfACollarLiesOnBothCylinders) {
  const LimbAxis parent = axis_through({{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, 0.5F);
  for (const double angle : {30.0, 60.0, 90.0, 120.0}) {
    LoopAngles angles;
    std::vector<LoopPoint> points;
    const ChildLimb child = child_of(angle, 0.2F, angles);
    const auto junction = collar_at(parent, 1, child, points);
    ASSERT_TRUE(junction) << angle;
    EXPECT_EQ(points.size(), 6U) << "two of eight corners are the ends";
    for (const LoopPoint& point : all_points(*junction, points)) {
      EXPECT_NEAR(std::hypot(point.position.x, point.position.z), 0.5, 1e-5) << "on the parent";
      const glm::vec3 off = point.position - glm::vec3(0, 2, 0);
      const glm::vec3 across = off - child.along * glm::dot(off, child.along);
      EXPECT_NEAR(glm::length(across), junction->radius, 1e-5) << "on the child";
      EXPECT_NEAR(point.height, point.position.y, 1e-5);
      EXPECT_NEAR(point.reach, glm::dot(off, child.along), 1e-5);
    }
  }
}

TEST(Junction, IsRefusedWhereTubesMeetTooFlatOrTooThick) {
  const LimbAxis parent = axis_through({{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, 0.5F);
  LoopAngles angles;
  std::vector<LoopPoint> points;
  EXPECT_FALSE(collar_at(parent, 1, child_of(10, 0.2F, angles), points)) << "sine below 0.3";
  EXPECT_FALSE(collar_at(parent, 1, child_of(60, 0.45F, angles), points)) << "wider than 0.86 of the parent";
  EXPECT_FALSE(fork_at(parent, 1, child_of(40, 0.1F, angles), points)) << "thinner than 0.4 of the parent";
  EXPECT_FALSE(fork_at(parent, 0, child_of(40, 0.4F, angles), points)) << "at the beginning of the parent";
}

TEST(Junction, OfAForkIsSymmetricAboutThePlaneOfBothLimbs) {
  const LimbAxis parent = axis_through({{0, 0, 0}, {0, 2, 0}, {-1, 4, 0}}, 0.3F);
  LoopAngles angles;
  std::vector<LoopPoint> points;
  const auto junction = fork_at(parent, 1, child_of(30, 0.3F, angles), points);
  ASSERT_TRUE(junction);
  const auto all = all_points(*junction, points);
  for (const LoopPoint& point : all) {
    float nearest = 1;
    for (const LoopPoint& other : all) {
      const glm::vec3 mirrored{other.position.x, other.position.y, -other.position.z};
      nearest = std::min(nearest, glm::distance(point.position, mirrored));
    }
    EXPECT_LT(nearest, 1e-5F);
  }
}

RingPlan plan_for(const LimbAxis& axis, const std::vector<ChildLimb>& children) {
  RingPlan plan;
  begin_plan(plan, 0, axis.length() - 0.1F, 1e-4F, 0.02F);
  for (const ChildLimb& child : children) add_junction(plan, axis, 1, child);
  complete_plan(plan, axis, false, {});
  return plan;
}

TEST(RingPlan, KeepsRingsWhereTheLimbTurnsByMoreThanNineDegrees) {
  for (const double degrees : {4.0, 8.0, 10.0, 40.0}) {
    const math::SinCos at = math::sincos_degrees(degrees);
    const LimbAxis axis = axis_through({{0, 0, 0}, {0, 2, 0}, {2 * at.sin, 2 + 2 * at.cos, 0}}, 0.1F);
    EXPECT_EQ(plan_for(axis, {}).ring.size(), degrees > 9 ? 2U : 1U) << degrees;
  }
}

TEST(RingPlan, PutsCollarsOfAWhorlOnOneRing) {
  const LimbAxis axis = axis_through({{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, 0.5F);
  LoopAngles angles;
  ChildLimb right = child_of(60, 0.15F, angles), left = right;
  left.along.x = -left.along.x;
  left.limb = 1;
  const RingPlan plan = plan_for(axis, {right, left});
  EXPECT_EQ(plan.junction.size(), 2U);
  EXPECT_EQ(plan.ring.size(), 2U) << "one for both, and one at the tip";
}

TEST(RingPlan, HasNoSpaceForTwoCollarsAtOnePosition) {
  const LimbAxis axis = axis_through({{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, 0.5F);
  LoopAngles angles;
  const ChildLimb child = child_of(60, 0.15F, angles);
  EXPECT_EQ(plan_for(axis, {child, child}).junction.size(), 1U);
}

}  // namespace
}  // namespace seedmesh
