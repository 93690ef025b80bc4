#include "core/geom/plant/widths.h"

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

TEST_F(Widths, CountAnInternodeByItsShare) {
  const auto with = [&](std::vector<float> shares) {
    Limbs limbs = fork();
    for (const float each : shares) limbs.share.push_back(each);
    return limbs;
  };
  for (const float little : {0.0F, 1e-6F}) {
    Limbs pipes = with({1, 1, 1, little, little});
    widen_by_pipes(pipes, {0.5, 2}, job);
    EXPECT_NEAR(pipes.radius[1], 0.5, 1e-3) << "the branch is not there yet, nor what follows the tip";
    EXPECT_NEAR(pipes.radius[2], 0.5, 1e-3);
    Limbs gone = with({1, 1, little, 1, 1});
    widen_by_pipes(gone, {0.5, 2}, job);
    EXPECT_NEAR(gone.radius[2], 0.5, 1e-3) << "what goes passes on what grows from it";
    Limbs chain = with({1, 1, 1, little, 1});
    widen_by_longest_chain(chain, {0.9, 0.3}, job);
    EXPECT_NEAR(chain.radius[1], 0.6, 1e-3) << "two links, one of them gone";
  }
  Limbs whole = with({1, 1, 1, 1, 1}), plain = fork();
  widen_by_pipes(whole, {0.5, 2}, job);
  widen_by_pipes(plain, {0.5, 2}, job);
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(whole.radius[i], plain.radius[i]);
}

TEST_F(Widths, LeaveAnEmptySkeletonEmpty) {
  Limbs none(job);
  widen_by_pipes(none, {}, job);
  widen_by_longest_chain(none, {}, job);
  EXPECT_EQ(none.size(), 0U);
}

}  // namespace
}  // namespace seedmesh
