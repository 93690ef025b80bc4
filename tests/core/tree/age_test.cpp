#include "core/generators/tree/age.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

std::vector<TreeParams> one_of_each_model() {
  std::vector<TreeParams> all(3);
  all[0].ScaleV = 0;
  all[1].model = TreeModel::proctree;
  all[2].model = TreeModel::sculpt;
  return all;
}

class Aged {
 public:
  Aged(const TreeParams& params, double share)
      : job_(3, Job::Options{}), skeleton_(skeleton_of(params, 3, job_)) {
    make_young(skeleton_, share, job_);
  }
  const Limbs& limbs() const { return skeleton_.limbs; }
  std::size_t leaves() const { return skeleton_.organs.organ.size(); }
  const Organs& organs() const { return skeleton_.organs; }

  /// Where the joint of each key is.
  std::map<std::uint64_t, glm::vec3> joints() const {
    std::map<std::uint64_t, glm::vec3> places;
    for (std::size_t i = 0; i < limbs().size(); ++i) places.emplace(limbs().key[i], limbs().position[i]);
    return places;
  }

 private:
  Job job_;
  Skeleton skeleton_;
};

float height_of(const Limbs& limbs) {
  float height = 0;
  for (const glm::vec3& p : limbs.position) height = std::max(height, p.y);
  return height;
}

TEST(Age, MovesNoLimbFarBetweenCloseAges) {
  for (const TreeParams& params : one_of_each_model()) {
    const float height = height_of(Aged(params, 1).limbs());
    constexpr int steps = 60;
    std::map<std::uint64_t, glm::vec3> before = Aged(params, 0).joints();
    float farthest = 0;
    for (int i = 1; i <= steps; ++i) {
      const Aged now(params, static_cast<double>(i) / steps);
      const auto places = now.joints();
      for (std::size_t k = 0; k < now.limbs().size(); ++k) {
        const auto was = before.find(now.limbs().key[k]);
        if (was != before.end()) {
          farthest = std::max(farthest, glm::distance(was->second, now.limbs().position[k]));
          continue;
        }
        // What was not there begins as small as the step lets it.
        const glm::vec3 from = now.limbs().position[now.limbs().parent[k]];
        farthest = std::max(farthest, glm::distance(from, now.limbs().position[k]));
      }
      before = places;
    }
    // In a tenth of a year of twenty no joint moves by more than a fortieth of the final height.
    EXPECT_LT(farthest, 0.025F * 200 / steps * height) << "model " << static_cast<int>(params.model);
    EXPECT_GT(farthest, 0.0F);
  }
}

TEST(Age, EndsWithTheWholeTreeAndBeginsWithASeedling) {
  for (const TreeParams& params : one_of_each_model()) {
    const Skeletons whole(params, 3);
    const Aged old(params, 1), new_born(params, 0);
    EXPECT_EQ(whole.limbs().position.size(), old.limbs().size());
    EXPECT_LT(height_of(new_born.limbs()), 0.02F * height_of(old.limbs()));
    EXPECT_EQ(new_born.leaves(), 0U);
  }
}

TEST(Age, AddsLimbsAndHeightEveryYear) {
  for (const TreeParams& params : one_of_each_model()) {
    std::size_t limbs = 0;
    float height = 0;
    for (const double share : {0.1, 0.3, 0.6, 1.0}) {
      const Aged tree(params, share);
      EXPECT_GE(tree.limbs().size(), limbs);
      EXPECT_GT(height_of(tree.limbs()), height);
      limbs = tree.limbs().size();
      height = height_of(tree.limbs());
    }
  }
}

TEST(Age, IsASmallTreeOfFewLimbsInItsFirstYears) {
  const Aged whole(TreeParams{}, 1);
  std::size_t limbs = 0;
  for (const double share : {0.05, 0.1, 0.15}) {
    const Aged young(TreeParams{}, share);
    std::size_t branches = 0, spread = 0;
    const float height = height_of(young.limbs());
    for (std::size_t i = 0; i < young.limbs().size(); ++i) {
      branches += young.limbs().starts_limb[i] ? 1U : 0U;
      const glm::vec3& p = young.limbs().position[i];
      spread += std::hypot(p.x, p.z) > 0.1F * height ? 1U : 0U;
    }
    EXPECT_GT(branches, 10U) << share;
    EXPECT_GT(branches, limbs) << share;
    EXPECT_GT(spread, 10U) << "limbs reach out at " << share;
    EXPECT_GT(young.leaves(), 0U) << share;
    EXPECT_LT(2 * young.leaves(), whole.leaves()) << share;
    limbs = branches;
  }
}

TEST(Age, HasLeavesOfFullSizeOnAYoungTree) {
  TreeParams params;
  const Aged young(params, 0.4);
  ASSERT_GT(young.leaves(), 50U);
  float longest = 0;
  for (const Organ& leaf : young.organs().organ) longest = std::max(longest, leaf.scale.y);
  EXPECT_FLOAT_EQ(longest, static_cast<float>(params.LeafScale));
}

TEST(Age, GivesASeedlingLeavesOnItsStem) {
  // Before most of the twigs that bear leaves have sprouted.
  for (const TreeParams& params : one_of_each_model()) {
    const Aged seedling(params, 0.04);
    ASSERT_GT(seedling.leaves(), 0U);
    for (const Organ& organ : seedling.organs().organ) {
      ASSERT_LT(organ.limb_joint, seedling.limbs().size());
      // None floats: each is where its joint is, or beside it.
      EXPECT_LT(glm::distance(organ.position, seedling.limbs().position[organ.limb_joint]),
                0.2F * height_of(seedling.limbs()));
    }
  }
}

TEST(Age, ShrinksTheFirstLeavesGradually) {
  for (const TreeParams& params : one_of_each_model()) {
    std::map<std::uint64_t, float> before;
    for (int i = 0; i <= 120; ++i) {
      std::map<std::uint64_t, float> now;
      const Aged aged(params, 0.001 * i);
      for (const Organ& organ : aged.organs().organ) now[organ.key] = organ.scale.y;
      const float largest = params.model == TreeModel::weber_penn ? 0.2F : 0.4F;
      for (const auto& [key, size] : before) {
        const auto still = now.find(key);
        EXPECT_LT(size - (still == now.end() ? 0 : still->second), 0.15F * largest) << i;
      }
      before = std::move(now);
    }
  }
}

TEST(Age, KeepsChildrenThinnerThanTheirParents) {
  const Aged young(TreeParams{}, 0.5);
  const Limbs& limbs = young.limbs();
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    if (limbs.parent[limbs.parent[i]] == Limbs::none) continue;
    EXPECT_LE(limbs.base_radius[i],
              1.001F * std::max(limbs.radius[limbs.parent[i]], limbs.base_radius[limbs.parent[i]]));
  }
}

}  // namespace
}  // namespace seedmesh::tree
