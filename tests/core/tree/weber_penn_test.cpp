#include "core/generators/tree/weber_penn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "core/geom/plant/graft/graft.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

TEST(WeberPennShape, GivesTheOutlinesOfThePaper) {
  const TreeParams p;
  const std::array<double, 8> at_half = {
      0.6, 1.0, 0.2 + 0.8 * std::sqrt(0.5), 1.0, 0.75, 0.5 / 0.7, 0.6, 0.5 + 0.25 / 0.7};
  for (int shape = 0; shape < 8; ++shape)
    EXPECT_NEAR(shape_ratio(p, shape, 0.5), at_half[static_cast<std::size_t>(shape)], 1e-12) << shape;
  EXPECT_NEAR(shape_ratio(p, 5, 0.7), 1, 1e-12);
  EXPECT_NEAR(shape_ratio(p, 7, 1), 0.5, 1e-12);
}

TEST(WeberPennShape, HasAnEnvelopeWithoutAStepAtItsPeak) {
  TreeParams p;
  p.PruneWidthPeak = 0.6;
  EXPECT_NEAR(shape_ratio(p, 8, 0.4 - 1e-9), 1, 1e-6);
  EXPECT_NEAR(shape_ratio(p, 8, 0.4 + 1e-9), 1, 1e-6);
  EXPECT_EQ(shape_ratio(p, 8, 1.2), 0);
  EXPECT_TRUE(is_in_envelope(p, 10, 0.1, 5));
  EXPECT_FALSE(is_in_envelope(p, 10, 5.1, 5));
}

TEST(WeberPennShape, RaisesToPowersAsTheLibraryDoes) {
  for (double base = 1e-32; base < 1e32; base *= 1.37) {
    for (const double exponent : {-3.3, 0.0, 0.3, 0.5, 1.0, 1.2, 2.0, 2.7, 7.9, 9.5}) {
      const double exact = math::pow(base, exponent);
      EXPECT_NEAR(power(base, exponent) / exact, 1, 1e-11) << base << " " << exponent;
    }
  }
  EXPECT_EQ(power(0, 1.2), 0);
  EXPECT_EQ(power(1, 1.3), 1);
}

TEST(WeberPennShape, TapersFromACylinderToBeads) {
  EXPECT_EQ(tapered(0, 1, 10, 0.9), 1);
  EXPECT_NEAR(tapered(1, 1, 10, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(tapered(0.5, 1, 10, 1), 0.5, 1e-12);
  // A cone cut by a half ball at its end.
  EXPECT_NEAR(tapered(2, 1, 10, 0.95), std::sqrt(1 - 0.5 * 0.5), 1e-12);
  EXPECT_NEAR(tapered(2, 1, 10, 1), 0, 1e-6);
  // Balls on a string: nothing between two, the whole radius in the middle of one.
  EXPECT_NEAR(tapered(3, 1, 10, 0.9), 1, 1e-12);
  EXPECT_NEAR(tapered(2.999999, 1, 10, 0.8), 0, 1e-2);
}

TEST(WeberPennShape, FlaresBelowAnEighthOfTheHeight) {
  EXPECT_NEAR(flared(0.6, 0), 1 + 0.6 * 0.99, 1e-12);
  EXPECT_EQ(flared(0.6, 0.125), 1);
  EXPECT_EQ(flared(0.6, 0.5), 1);
}

Skeleton grown_by(int threads, const TreeParams& params, const Limits& limits, std::string& refusal) {
  Job job(7, {.limits = limits, .threads = threads});
  Skeleton skeleton(job);
  SkeletonWriter writer(skeleton, job);
  try {
    grow_weber_penn(params, RandomStreams(params.seeds, 7), writer);
  } catch (const Stop& stop) {
    refusal = stop.issue().message;
  }
  return skeleton;
}

TEST(WeberPenn, GrowsTheSameOnAnyNumberOfThreads) {
  TreeParams params;
  params.split_angle_0 = 20;
  struct Trunk {
    double splits;
    int at_base, segments;
  };
  // One, some, some from the ground, and more than are grown ahead.
  for (const Trunk& trunk : {Trunk{0, 0, 3}, Trunk{0.6, 0, 3}, Trunk{0.3, 2, 8}, Trunk{1, 1, 6}}) {
    params.seg_splits_0 = trunk.splits;
    params.base_splits = trunk.at_base;
    params.curve_res_0 = trunk.segments;
    std::string refusal;
    const Skeleton one = grown_by(1, params, Limits{}, refusal);
    EXPECT_GT(one.limbs.size(), 3000U);
    for (const int threads : {2, 3, 8}) {
      const Skeleton other = grown_by(threads, params, Limits{}, refusal);
      EXPECT_EQ(refusal, "");
      ASSERT_EQ(one.limbs.size(), other.limbs.size());
      for (std::size_t i = 0; i < one.limbs.size(); ++i) {
        ASSERT_EQ(one.limbs.position[i], other.limbs.position[i]) << i;
        ASSERT_EQ(one.limbs.parent[i], other.limbs.parent[i]) << i;
        ASSERT_EQ(one.limbs.key[i], other.limbs.key[i]) << i;
      }
      ASSERT_EQ(one.organs.organ.size(), other.organs.organ.size());
      for (std::size_t i = 0; i < one.organs.organ.size(); ++i) {
        const Organ &a = one.organs.organ[i], &b = other.organs.organ[i];
        ASSERT_TRUE(a.position == b.position && a.frame == b.frame && a.scale == b.scale && a.key == b.key &&
                    a.limb_joint == b.limb_joint)
            << i;
      }
    }
  }
}

Skeleton grown_without(double radius, const TreeParams& params) {
  Job job(7, Job::Options{});
  Skeleton skeleton(job);
  SkeletonWriter writer(skeleton, job, 0.5);
  writer.leave_out_below(radius);
  grow_weber_penn(params, RandomStreams(params.seeds, 7), writer);
  return skeleton;
}

TEST(WeberPenn, GrowsTheSameLeavesWhenTheTwigsAreNotDrawn) {
  TreeParams params;
  params.curve_res_2 = 1;
  for (const double prune : {0.0, 1.0}) {
    params.PruneRatio = prune;
    params.PruneWidth = 0.25;
    const Skeleton all = grown_without(0, params), thick = grown_without(1, params);
    EXPECT_GT(all.limbs.size(), 2 * thick.limbs.size());
    ASSERT_EQ(all.organs.organ.size(), thick.organs.organ.size());
    EXPECT_GT(all.organs.organ.size(), 1000U);
    for (std::size_t i = 0; i < all.organs.organ.size(); ++i) {
      const Organ &a = all.organs.organ[i], &b = thick.organs.organ[i];
      ASSERT_TRUE(a.position == b.position && a.frame == b.frame && a.key == b.key) << i;
    }
  }
}

TEST(WeberPenn, IsRefusedOnAnyNumberOfThreadsAboveALimit) {
  const TreeParams params;
  Limits few_joints, few_leaves;
  few_joints.modules = 2000;
  few_leaves.shapes = 9000;
  for (const Limits& limits : {few_joints, few_leaves}) {
    std::string first;
    grown_by(1, params, limits, first);
    EXPECT_NE(first.find("the limit is"), std::string::npos) << first;
    for (const int threads : {2, 8}) {
      std::string refusal;
      grown_by(threads, params, limits, refusal);
      EXPECT_EQ(refusal, first);
    }
  }
}

TEST(WeberPenn, GrowsTheAspenOfThePaper) {
  const TreeParams params;  // the defaults are the aspen
  const Grown tree = grown(params, 7);
  ASSERT_EQ(tree.levels.size(), 3U);
  EXPECT_EQ(tree.levels[0].count, 1U);
  EXPECT_EQ(tree.levels[1].count, 50U);
  EXPECT_GE(tree.trunk_length, 10.0);
  EXPECT_LE(tree.trunk_length, 16.0);
  // 30 (0.2 + 0.8 l / (trunk 0.3)) of each limb of length l; rounded for each of the fifty.
  EXPECT_NEAR(static_cast<double>(tree.levels[2].count), tree.expected_second, 50 * 0.5);
  // 25 (0.5 + 0.5 offset / length), on average three quarters of 25.
  EXPECT_NEAR(static_cast<double>(tree.leaves) / static_cast<double>(tree.levels[2].count), 0.75 * 25, 1.0);
  // Radius = length x Ratio, without the flare, and a child's by the ratio of lengths to the power.
  EXPECT_NEAR(tree.trunk_radius, tree.trunk_length * 0.015 * flared(0.6, 0), 1e-4);
}

TEST(WeberPenn, KeepsItsTrunkWhenBranchesHaveASeedOfTheirOwn) {
  TreeParams params;
  params.seeds.trunk = 5;
  Skeletons one(params, 1), other(params, 2);
  EXPECT_EQ(one.trunk(), other.trunk());
  EXPECT_NE(one.tips(), other.tips());
}

TEST(WeberPenn, KeepsItsLimbsWhenLeavesHaveASeedOfTheirOwn) {
  TreeParams params;
  params.seeds.trunk = 5;
  params.seeds.branches = 6;
  Skeletons one(params, 1), other(params, 2);
  EXPECT_EQ(one.tips(), other.tips());
}

TEST(WeberPenn, EndsInsideTheEnvelopeWhereItIsPruned) {
  TreeParams params;
  params.PruneRatio = 1;
  params.PruneWidth = 0.15;
  Skeletons pruned(params, 3);
  params.PruneRatio = 0;
  Skeletons free(params, 3);
  EXPECT_LT(pruned.widest(), 0.7F * free.widest());
}

TEST(WeberPenn, KeepsTheTrunkWhenItsBranchesChange) {
  TreeParams params;
  Skeletons before(params, 9);
  params.branches_2 = 3;
  params.curve_1 = 20;
  Skeletons after(params, 9);
  EXPECT_EQ(before.trunk_ends(), after.trunk_ends());
}

/// Twigs of the last level are thinner than this.
TreeParams twiggy() {
  TreeParams params;
  params.Levels = 4;
  params.branches_1 = 12;
  params.branches_3 = 6;
  params.length_3 = 0.4;
  params.Leaves = 5;
  params.PruneRatio = 0.5;
  return params;
}
constexpr float thinnest = 0.004F;

TEST(WeberPenn, KeepsBarkAndLeavesWhenUndrawnLimbsAreOmitted) {
  Job job(4, Job::Options{});
  const Skeleton whole = skeleton_of(twiggy(), 4, job), less = skeleton_of(twiggy(), 4, job, thinnest);
  EXPECT_LT(3 * less.limbs.size(), 2 * whole.limbs.size());
  const Box box = bounds_of(whole.limbs.position.span()), same = bounds_of(less.limbs.position.span());
  EXPECT_EQ(box.min, same.min);
  EXPECT_EQ(box.max, same.max);
  ASSERT_EQ(whole.organs.organ.size(), less.organs.organ.size());
  for (std::size_t i = 0; i < whole.organs.organ.size(); ++i) {
    EXPECT_EQ(whole.organs.organ[i].position, less.organs.organ[i].position) << i;
    EXPECT_EQ(whole.organs.organ[i].frame, less.organs.organ[i].frame) << i;
  }
  GraftOptions options;
  options.thinnest = thinnest;
  const Mesh bark = graft(whole.limbs, options, job), drawn = graft(less.limbs, options, job);
  ASSERT_EQ(bark.position.size(), drawn.position.size());
  EXPECT_TRUE(std::equal(bark.position.begin(), bark.position.end(), drawn.position.begin()));
  EXPECT_TRUE(std::equal(bark.normal.begin(), bark.normal.end(), drawn.normal.begin()));
  ASSERT_EQ(bark.index.wide.size(), drawn.index.wide.size());
  EXPECT_TRUE(std::equal(bark.index.wide.begin(), bark.index.wide.end(), drawn.index.wide.begin()));
}

TEST(WeberPenn, OmitsTheSameLimbsOnAnyNumberOfThreads) {
  Job one(4, Job::Options{}), two(4, {.threads = 2});
  const Skeleton a = skeleton_of(twiggy(), 4, one, thinnest), b = skeleton_of(twiggy(), 4, two, thinnest);
  ASSERT_EQ(a.limbs.size(), b.limbs.size());
  EXPECT_TRUE(std::equal(a.limbs.position.begin(), a.limbs.position.end(), b.limbs.position.begin()));
  EXPECT_TRUE(std::equal(a.limbs.parent.begin(), a.limbs.parent.end(), b.limbs.parent.begin()));
  ASSERT_EQ(a.organs.organ.size(), b.organs.organ.size());
  for (std::size_t i = 0; i < a.organs.organ.size(); ++i)
    EXPECT_EQ(a.organs.organ[i].limb_joint, b.organs.organ[i].limb_joint) << i;
}

TEST(WeberPenn, MakesOnlyTheLeavesOfAShare) {
  Job job(4, Job::Options{});
  const Skeleton all = skeleton_of(twiggy(), 4, job);
  Skeleton some(job);
  SkeletonWriter writer(some, job, 0.3);
  const TreeParams params = twiggy();
  grow_weber_penn(params, RandomStreams(params.seeds, 4), writer);
  std::vector<std::uint64_t> wanted, found;
  for (const Organ& leaf : all.organs.organ) {
    if (is_drawn(leaf.key, 0.3)) wanted.push_back(leaf.key);
  }
  for (const Organ& leaf : some.organs.organ) found.push_back(leaf.key);
  EXPECT_EQ(wanted, found);
  EXPECT_FALSE(found.empty());
}

TEST(WeberPenn, HasNoJointsForTwigsThatAreNotDrawn) {
  TreeParams params;
  params.Levels = 3;
  params.branches_1 = 8;
  params.branches_2 = 10;
  params.length_2 = 0.05;
  params.RatioPower = 2;
  params.Ratio = 0.03;
  const auto joints_of_limbs = [&] {
    std::size_t count = 0;
    const Skeletons grown(params, 3);
    for (const std::uint16_t order : grown.limbs().order) count += order == 1 ? 1 : 0;
    return count;
  };
  const std::size_t few = joints_of_limbs();
  params.branches_2 = 300;
  params.twig_radius = 0;
  const std::size_t drawn = joints_of_limbs();
  params.twig_radius = 0.01;
  EXPECT_LT(joints_of_limbs(), few);
  EXPECT_GT(drawn, 5 * few);
}

TEST(WeberPenn, ApproximatesTheInverseCosine) {
  for (double angle = 0; angle < math::pi; angle += 0.01)
    EXPECT_NEAR(approximate_acos(std::cos(angle)), angle, 1e-7);
}

}  // namespace
}  // namespace seedmesh::tree
