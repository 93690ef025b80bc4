/// Section 4.9 of Weber and Penn: fewer and fewer limbs and leaves the farther a tree is.
#include "core/generators/tree/range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

TreeParams at_range(double range) {
  TreeParams params;
  params.range = range;
  return params;
}

struct Degraded {
  explicit Degraded(const TreeParams& params)
      : job(7, Job::Options{}), skeleton(skeleton_of(params, 7, job)) {
    degrade(skeleton, params, job);
  }
  std::set<std::uint64_t> keys(int order) const {
    std::set<std::uint64_t> out;
    for (std::size_t i = 0; i < skeleton.limbs.size(); ++i) {
      if (skeleton.limbs.order[i] == order) out.insert(skeleton.limbs.key[i]);
    }
    return out;
  }
  std::size_t limbs_of(int order) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < skeleton.limbs.size(); ++i)
      count += skeleton.limbs.starts_limb[i] && skeleton.limbs.order[i] == order ? 1U : 0U;
    return count;
  }
  Job job;
  Skeleton skeleton;
};

TEST(Range, GivesTheSharesOfThePaper) {
  const auto shares = [](double range) { return shares_at(at_range(range)); };
  EXPECT_EQ(shares(0).leaves, 1);
  EXPECT_NEAR(shares(50).leaves, 1, 1e-12) << "whole up to a quarter of 200 m";
  EXPECT_NEAR(shares(125).leaves, 0.5, 1e-12) << "4/3 - 125 / 150";
  EXPECT_EQ(shares(600).leaves, 1.0 / 8) << "1,664 of 13,312";
  EXPECT_NEAR(shares(50).twigs, 1, 1e-12);
  EXPECT_NEAR(shares(75).twigs, 0.5, 1e-12);
  EXPECT_EQ(shares(100).twigs, 0);
  EXPECT_NEAR(shares(300).branches, 1, 1e-12);
  EXPECT_NEAR(shares(600).branches, 0.5, 1e-12);
  EXPECT_NEAR(shares(800).sides, 1.0 / 6, 1e-12);
  EXPECT_EQ(shares(100000).branches, 0);
}

TEST(Range, LosesLeavesSoonerInSpring) {
  TreeParams params = at_range(62.5);
  EXPECT_GT(shares_at(params).leaves, 0.9);
  params.season = TreeSeason::spring;
  EXPECT_NEAR(shares_at(params).leaves, 0.5, 1e-12);
}

TEST(Range, DrawsTheGivenNumberOfLimbsOfEachLevel) {
  const Degraded near(at_range(0)), half(at_range(75)), far(at_range(600));
  EXPECT_NEAR(static_cast<double>(half.limbs_of(2)) / static_cast<double>(near.limbs_of(2)), 0.5, 0.05);
  EXPECT_EQ(half.limbs_of(1), near.limbs_of(1));
  EXPECT_EQ(far.limbs_of(2), 0U);
  EXPECT_NEAR(static_cast<double>(far.limbs_of(1)), 25, 8);
  EXPECT_EQ(far.limbs_of(0), near.limbs_of(0)) << "the trunk stays";
}

TEST(Range, DrawsAtADistanceASubsetOfTheNearLimbs) {
  const Degraded near(at_range(60)), far(at_range(90));
  const std::set<std::uint64_t> more = near.keys(2), fewer = far.keys(2);
  EXPECT_LT(fewer.size(), more.size());
  EXPECT_TRUE(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end()));
}

TEST(Range, KeepsLeavesOnTheRemainingLimbs) {
  const Degraded far(at_range(600));
  ASSERT_GT(far.skeleton.organs.organ.size(), 1000U);
  for (const Organ& leaf : far.skeleton.organs.organ) ASSERT_LT(leaf.limb_joint, far.skeleton.limbs.size());
}

}  // namespace
}  // namespace seedmesh::tree
