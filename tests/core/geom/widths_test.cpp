#include "core/geom/widths.h"

#include <gtest/gtest.h>

#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

class Widths : public testing::Test {
 protected:
  /// A trunk of three internodes with a branch of one at the first fork.
  Limbs fork() {
    SkeletonMaker maker(job);
    const auto root = maker.root({0, 0, 0});
    const auto low = maker.grow(root, {0, 1, 0}, {1, 1});
    const auto middle = maker.grow(low, {0, 2, 0}, {1, 1});
    maker.grow(middle, {0, 3, 0}, {1, 1});
    maker.branch(low, {1, 1, 0}, {1, 1});
    maker.limbs.order[4] = 1;
    return std::move(maker.limbs);
  }
  Job job{1, Job::Options{}};
};

TEST_F(Widths, HalveInEveryBracket) {
  Limbs limbs = fork();
  narrow_by_order(limbs, 0.5, job);
  EXPECT_EQ(limbs.radius[3], 1);
  EXPECT_EQ(limbs.radius[4], 0.5F);
  EXPECT_EQ(limbs.base_radius[4], 0.5F);
}

TEST_F(Widths, FollowTheLongestChainFromBaseToTip) {
  Limbs limbs = fork();
  widen_by_longest_chain(limbs, {0.9, 0.3}, job);
  EXPECT_FLOAT_EQ(limbs.base_radius[1], 0.9F);
  EXPECT_FLOAT_EQ(limbs.radius[1], 0.7F);
  EXPECT_FLOAT_EQ(limbs.base_radius[2], 0.7F);
  EXPECT_FLOAT_EQ(limbs.radius[3], 0.3F);
  EXPECT_FLOAT_EQ(limbs.base_radius[4], 0.5F) << "a branch of one link is as thick as one link";
  EXPECT_FLOAT_EQ(limbs.radius[4], 0.3F);
}

TEST_F(Widths, AddUpPipesWhereLimbsMeet) {
  Limbs limbs = fork();
  widen_by_pipes(limbs, {0.1, 2}, job);
  EXPECT_FLOAT_EQ(limbs.radius[3], 0.1F);
  EXPECT_FLOAT_EQ(limbs.radius[1] * limbs.radius[1], 0.02F) << "two tips";
  widen_by_pipes(limbs, {0.1, 2.5}, job);
  EXPECT_NEAR(limbs.radius[1], 0.1 * math::pow(2, 0.4), 1e-7);
}

TEST_F(Widths, LeaveAnEmptySkeletonEmpty) {
  Limbs none(job);
  widen_by_pipes(none, {}, job);
  widen_by_longest_chain(none, {}, job);
  EXPECT_EQ(none.size(), 0U);
}

}  // namespace
}  // namespace seedmesh
