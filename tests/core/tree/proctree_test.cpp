#include "core/generators/tree/proctree.h"

#include <gtest/gtest.h>

#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

TreeParams proctree(int levels, int steps) {
  TreeParams params;
  params.model = TreeModel::proctree;
  params.mLevels = levels;
  params.mTreeSteps = steps;
  return params;
}

TEST(Proctree, HasAsManyTwigsAsTheOriginal) {
  for (const auto& [levels, steps] : {std::pair{1, 0}, {3, 0}, {5, 5}, {4, 8}}) {
    const Skeletons tree(proctree(levels, steps), 1);
    EXPECT_EQ(tree.organs().organ.size(), (2U << levels) + static_cast<unsigned>(steps) * (1U << levels));
  }
}

TEST(Proctree, ForksTheTrunkAtItsPublishedHeight) {
  const Skeletons tree(proctree(5, 5), 1);
  EXPECT_FLOAT_EQ(tree.limbs().position[1].y, 2.4F);
  EXPECT_FLOAT_EQ(tree.limbs().base_radius[1], 0.139F);
}

TEST(Proctree, ClimbsByTheClimbRateAndThinsByTheTaperRate) {
  TreeParams params = proctree(3, 4);
  params.mTrunkKink = 0;
  const Skeletons tree(params, 4);
  const Limbs& limbs = tree.limbs();
  std::uint32_t joint = 1;
  for (int step = 0; step < 4; ++step) {
    std::uint32_t next = joint + 1;
    while (limbs.parent[next] != joint || limbs.starts_limb[next]) ++next;
    EXPECT_NEAR(limbs.position[next].y - limbs.position[joint].y, 0.371, 1e-5);
    EXPECT_NEAR(limbs.base_radius[next] / limbs.base_radius[joint], 0.947, 1e-5);
    joint = next;
  }
}

TEST(Proctree, DiffersFromSeedToSeed) {
  EXPECT_NE(Skeletons(proctree(5, 5), 1).tips(), Skeletons(proctree(5, 5), 2).tips());
}

}  // namespace
}  // namespace seedmesh::tree
