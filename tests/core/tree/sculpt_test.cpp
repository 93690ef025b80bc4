#include "core/generators/tree/sculpt.h"

#include <gtest/gtest.h>

#include "core/generators/tree/range.h"
#include "core/geom/plant/tube_formulas.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

/// A tree without any chance.
TreeParams still() {
  TreeParams params;
  params.model = TreeModel::sculpt;
  params.sculpt.height = 10;
  params.sculpt.height_spread = 0;
  TreeLevel level;
  level.angle_spread = level.phase_spread = level.fill_spread = 0;
  params.sculpt.level = {level, level};
  params.sculpt.levels = 2;
  return params;
}

/// Joints of the trunk, from the foot.
std::vector<glm::vec3> trunk(const TreeParams& params) { return Skeletons(params, 1).trunk(); }

TEST(Sculpt, ShrinksTheGapsBetweenWhorlsTowardTheTip) {
  TreeParams params = still();
  params.sculpt.level[0].bend = 0;
  params.sculpt.level[0].gap = 0.1;
  params.sculpt.level[0].gap_ratio = 0.8;
  const std::vector<glm::vec3> joints = trunk(params);
  ASSERT_GT(joints.size(), 5U);
  EXPECT_NEAR(joints[1].y - joints[0].y, 1.0, 1e-5);
  for (std::size_t i = 2; i + 2 < joints.size(); ++i) {
    EXPECT_NEAR((joints[i].y - joints[i - 1].y) / (joints[i - 1].y - joints[i - 2].y), 0.8, 1e-4);
  }
}

TEST(Sculpt, PutsAWhorlOfLimbsOnEveryCut) {
  TreeParams params = still();
  params.sculpt.level[0].whorl = 5;
  params.sculpt.shortest = 0.01;
  const Skeletons tree(params, 1);
  std::vector<int> children(tree.limbs().size(), 0);
  for (std::size_t i = 1; i < tree.limbs().size(); ++i) {
    if (tree.limbs().starts_limb[i]) ++children[tree.limbs().parent[i]];
  }
  for (const int count : children) EXPECT_TRUE(count == 0 || count == 5);
}

TEST(Sculpt, FitsLimbsIntoTheBoundingShape) {
  for (const TreeShape shape : {TreeShape::cone, TreeShape::sphere, TreeShape::cylinder}) {
    TreeParams params = still();
    params.sculpt.level[0].shape = shape;
    params.sculpt.level[0].bend = params.sculpt.level[1].bend = 0;
    params.sculpt.level[0].width = 0.3;
    const Skeletons tree(params, 1);
    float widest = 0;
    for (const glm::vec3& p : tree.limbs().position) {
      const float aside = std::sqrt(p.x * p.x + p.z * p.z), share = p.y / 10;
      widest = std::max(widest, aside);
      const float room = shape == TreeShape::cone     ? 3 * (1 - share)
                         : shape == TreeShape::sphere ? 6 * std::sqrt(std::max(0.0F, share * (1 - share)))
                                                      : 3.0F;
      EXPECT_LE(aside, room + 1e-3F);
    }
    EXPECT_GT(widest, 1.5F) << "the shape is used";
  }
}

TEST(Sculpt, MeasuresTheDistanceToTheSidesOfABox) {
  TreeLevel level;
  level.shape = TreeShape::box;
  level.width = 0.5;
  EXPECT_NEAR(distance_in_shape(level, 10, 5, {1, 0, 0}), 5, 1e-4);
  EXPECT_NEAR(distance_in_shape(level, 10, 5, {std::sqrt(0.5), 0, std::sqrt(0.5)}), 5 * std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(distance_in_shape(level, 10, 5, {0, 1, 0}), 5, 1e-4);
}

TEST(Sculpt, RevolvesTheProfileOfALatheShape) {
  TreeLevel level;
  level.shape = TreeShape::lathe;
  level.width = 1;
  level.profile = {0, 1, 0};
  EXPECT_NEAR(distance_in_shape(level, 10, 5, {1, 0, 0}), 10, 1e-3);
  EXPECT_NEAR(distance_in_shape(level, 10, 2.5, {1, 0, 0}), 5, 1e-3);
}

TEST(Sculpt, EndsAtTheShortestLimbAndAtTheLastLevel) {
  TreeParams params = still();
  params.sculpt.levels = 6;
  params.sculpt.shortest = 1.5;
  const Skeletons tree(params, 1);
  int deepest = 0;
  for (std::size_t i = 1; i < tree.limbs().size(); ++i) {
    deepest = std::max<int>(deepest, tree.limbs().order[i]);
    if (tree.limbs().starts_limb[i]) {
      EXPECT_GE(length_from(tree.limbs(), i), 1.5 - 1e-4);
    }
  }
  EXPECT_LT(deepest, 5) << "limbs were too short before the levels were through";
  params.sculpt.levels = 2;
  const Skeletons two(params, 1);
  for (const std::uint16_t order : two.limbs().order) EXPECT_LE(order, 1);
}

TEST(Sculpt, TapersByAnAngle) {
  TreeParams params = still();
  params.sculpt.level[0].taper = 2;
  params.sculpt.tip_radius = 0.01;
  const Skeletons tree(params, 1);
  EXPECT_NEAR(tree.limbs().base_radius[1], 0.01 + 10 * std::tan(2 * math::pi / 180), 1e-5);
}

TEST(Sculpt, BendsToOneSideWithoutSpinAndInASpiralWithIt) {
  TreeParams params = still();
  params.sculpt.level[0].bend = 4;
  params.sculpt.level[0].spin = 0;
  const auto aside = [](const std::vector<glm::vec3>& joints) {
    return std::sqrt(joints.back().x * joints.back().x + joints.back().z * joints.back().z);
  };
  const float bow = aside(trunk(params));
  params.sculpt.level[0].spin = 137.5;
  EXPECT_GT(bow, 2.0F);
  EXPECT_LT(aside(trunk(params)), 0.25F * bow);
}

TEST(Sculpt, IsTheSameForEverySeedWithoutRandomParameters) {
  const TreeParams params = still();
  const Skeletons one(params, 1), other(params, 2);
  ASSERT_EQ(one.limbs().size(), other.limbs().size());
  for (std::size_t i = 0; i < one.limbs().size(); ++i) {
    // The trunk's first direction about itself is drawn; heights and lengths are not.
    EXPECT_NEAR(one.limbs().position[i].y, other.limbs().position[i].y, 1e-3F);
  }
}

TEST(Sculpt, TakesTheRadiusOfTheTrunkFromItsOption) {
  TreeParams params = still();
  const float tapered = Skeletons(params, 1).limbs().base_radius[1];
  EXPECT_NEAR(tapered, 0.004 + 10 * std::tan(0.9 * 3.14159265358979 / 180), 1e-5) << "tip and taper";
  params.sculpt.trunk_radius = 0.5;
  const Skeletons tree(params, 1);
  EXPECT_FLOAT_EQ(tree.limbs().base_radius[1], 0.5F);
  EXPECT_NEAR(tree.trunk().back().y, 10, 0.2) << "as high as before";
}

TEST(Sculpt, LosesFacesLinearlyWithDistanceAndKeepsItsLimbs) {
  TreeParams params = still();
  params.sculpt.faces = TreeFaces::linear;
  for (const double range : {0.0, 150.0, 300.0, 500.0, 2000.0}) {
    params.range = range;
    const RangeShares shares = shares_at(params);
    EXPECT_NEAR(shares.sides, std::max(1.0 / 6, 1 - range / 600), 1e-12) << range;
    EXPECT_EQ(shares.branches, 1);
    EXPECT_EQ(shares.twigs, 1);
  }
  EXPECT_EQ(corners_by_radius(0.25F, 1, 24, 1), 6) << "in proportion to the radius";
  EXPECT_EQ(corners_by_radius(0.5F, 1, 24, 1), 12);
}

}  // namespace
}  // namespace seedmesh::tree
