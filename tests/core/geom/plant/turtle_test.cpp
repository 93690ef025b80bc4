#include "core/geom/plant/turtle.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

class TurtleTest : public testing::Test {
 protected:
  Job job{1, Job::Options{}};
  Skeleton skeleton{job};
  Turtle turtle{&skeleton, 0.2, job};
  const math::SinCos right_angle = math::sincos_degrees(90);
};

void expect_at(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], 1e-12) << "axis " << axis;
}

TEST_F(TurtleTest, StartsAtTheOriginAndHeadsUp) {
  expect_at(turtle.position(), {0, 0, 0});
  expect_at(turtle.frame().heading, {0, 1, 0});
  expect_at(turtle.frame().left, {-1, 0, 0});
  expect_at(turtle.frame().up, {0, 0, 1});
}

TEST_F(TurtleTest, ComesHomeAfterFourLeftTurns) {
  for (int side = 0; side < 4; ++side) {
    turtle.draw(2, 0);
    turtle.turn(right_angle);
  }
  expect_at(turtle.position(), {0, 0, 0});
  EXPECT_EQ(turtle.report().segments, 4U);
  EXPECT_EQ(turtle.report().total_length, 8);
  expect_at(turtle.report().min, {-2, 0, 0});
  expect_at(turtle.report().max, {0, 2, 0});
}

TEST_F(TurtleTest, PitchesDownAwayFromUp) {
  turtle.pitch(right_angle);
  expect_at(turtle.frame().heading, {0, 0, -1});
}

TEST_F(TurtleTest, RollsLeftTowardsUp) {
  turtle.roll(right_angle);
  expect_at(turtle.frame().left, {0, 0, 1});
}

TEST_F(TurtleTest, SetsDownWhatItDrewOnceWhereverItIs) {
  const auto hook = [&](Turtle& each) {
    each.draw(2, 0);
    each.push();
    each.turn(right_angle);
    each.draw(1, 0);
    each.pop();
    each.pitch(right_angle);
  };
  turtle.draw(1, 0);
  Turtle::Recording recording(job);
  Turtle drawer(&recording.skeleton, 0.2, job);
  drawer.begin_recording(turtle, recording);
  hook(drawer);
  drawer.end_recording(recording);

  Skeleton by_hand(job);
  Turtle other(&by_hand, 0.2, job);
  other.draw(1, 0);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(turtle.matches(recording));
    turtle.append_copy(recording);
    hook(other);
  }
  const Limbs &copied = skeleton.limbs, &drawn = by_hand.limbs;
  ASSERT_EQ(copied.size(), drawn.size());
  for (std::size_t joint = 0; joint < drawn.size(); ++joint) {
    expect_at(copied.position[joint], drawn.position[joint]);
    EXPECT_EQ(copied.parent[joint], drawn.parent[joint]);
    EXPECT_EQ(copied.order[joint], drawn.order[joint]);
    EXPECT_EQ(copied.starts_limb[joint], drawn.starts_limb[joint]);
  }
  expect_at(turtle.position(), other.position());
  expect_at(turtle.frame().heading, other.frame().heading);
  EXPECT_EQ(turtle.report().segments, 7U);
  turtle.set_width(0.3);
  EXPECT_FALSE(turtle.matches(recording));
}

TEST_F(TurtleTest, ContinuesALimbAfterABranch) {
  turtle.draw(1, 0);
  turtle.push();
  turtle.turn(right_angle);
  turtle.draw(1, 0);
  turtle.pop();
  turtle.draw(1, 0);
  const Limbs& limbs = skeleton.limbs;
  ASSERT_EQ(limbs.size(), 4U);
  EXPECT_EQ(limbs.parent[2], 1U);
  EXPECT_EQ(limbs.starts_limb[2], 1);
  EXPECT_EQ(limbs.order[2], 1);
  EXPECT_EQ(limbs.parent[3], 1U);
  EXPECT_EQ(limbs.starts_limb[3], 0);
  EXPECT_EQ(limbs.order[3], 0);
}

TEST_F(TurtleTest, StartsANewRootAfterAMove) {
  turtle.draw(1, 0);
  turtle.walk(1);
  turtle.draw(1, 0);
  ASSERT_EQ(skeleton.limbs.size(), 4U);
  EXPECT_EQ(skeleton.limbs.parent[2], Limbs::none);
  EXPECT_EQ(skeleton.limbs.position[2].y, 2);
}

TEST_F(TurtleTest, TapersFromTheWidthBeforeToTheWidthNow) {
  turtle.draw(1, 0);
  turtle.set_width(0.1);
  turtle.draw(1, 0);
  EXPECT_FLOAT_EQ(skeleton.limbs.base_radius[2], 0.1F);
  EXPECT_FLOAT_EQ(skeleton.limbs.radius[2], 0.05F);
}

TEST_F(TurtleTest, CollectsAPolygonAcrossBranches) {
  turtle.open_polygon();
  turtle.set_vertex();
  turtle.push();
  turtle.draw(1, 0);
  turtle.pop();
  turtle.turn(right_angle);
  turtle.walk(1);
  turtle.close_polygon(0);
  ASSERT_EQ(skeleton.outlines.outline.size(), 1U);
  EXPECT_EQ(skeleton.outlines.outline[0].count, 3U);
  EXPECT_EQ(skeleton.limbs.size(), 0U);
}

TEST_F(TurtleTest, LeavesPlainMovesOutOfPolygons) {
  turtle.open_polygon();
  turtle.draw_plain(1, 0);
  turtle.walk_plain(1);
  turtle.close_polygon(0);
  EXPECT_TRUE(skeleton.outlines.outline.empty());
  EXPECT_EQ(turtle.report().vertices, 0U);
}

TEST_F(TurtleTest, StaysOrthonormalThroughAMillionTurns) {
  const math::SinCos angle = math::sincos_degrees(137.5);
  for (int i = 0; i < 1'000'000; ++i) {
    turtle.turn(angle);
    turtle.pitch(angle);
  }
  const Frame& f = turtle.frame();
  EXPECT_NEAR(glm::dot(f.heading, f.heading), 1, 1e-13);
  EXPECT_NEAR(glm::dot(f.heading, f.left), 0, 1e-13);
  expect_at(glm::cross(f.heading, f.left), f.up);
}

TEST_F(TurtleTest, KeepsKeysBesideTheirJointsWhereOnlySomeHaveOne) {
  turtle.draw(1, 0);
  turtle.draw(1, 7);
  turtle.draw(1, 0);
  const auto keys = skeleton.limbs.key.span();
  EXPECT_EQ(std::vector<std::uint64_t>(keys.begin(), keys.end()), (std::vector<std::uint64_t>{0, 0, 7, 0}));
}

TEST_F(TurtleTest, StaysWhereItIsAndReportsPositionsBeyondTheWorld) {
  turtle.draw(1, 0);
  const glm::dvec3 before = turtle.position();
  EXPECT_FALSE(turtle.is_out_of_range());
  turtle.draw(1e16, 0);
  EXPECT_TRUE(turtle.is_out_of_range());
  EXPECT_EQ(turtle.position(), before);
}

TEST_F(TurtleTest, RefusesBracketsDeeperThanTheLimit) {
  const auto nest = [&] {
    for (int i = 0; i < 20000; ++i) turtle.push();
  };
  EXPECT_THROW(nest(), Stop);
}

}  // namespace
}  // namespace seedmesh
