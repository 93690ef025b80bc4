#include "core/generators/tree/ez_tree.h"

#include <gtest/gtest.h>

#include "core/generators/tree/ez_tree_turns.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

TreeParams ez_tree() {
  TreeParams params;
  params.model = TreeModel::ez_tree;
  return params;
}

TEST(EzTree, DrawsTheNumbersOfTheOriginal) {
  // The first numbers of its class RNG (npm @dgreenheck/ez-tree 1.1.0) in node.
  EzTreeRandom first(23399), second(4000000000);
  for (const double number :
       {0.30555093940347433, 0.6112000863067806, 0.28489032993093133, 0.1323408444877714})
    EXPECT_EQ(first.between(0, 1), number);
  for (const double number : {0.39471878623589873, 0.33755506202578545, 0.2909376274328679})
    EXPECT_EQ(second.between(0, 1), number);
}

TEST(EzTree, TurnsBackAndForthBetweenAnglesAndQuaternions) {
  Rng rng(5);
  for (int i = 0; i < 10'000; ++i) {
    const glm::dvec3 angles{rng.uniform(-3, 3), rng.uniform(-1.5, 1.5), rng.uniform(-3, 3)};
    const glm::dvec3 back = angles_of(turn_of_angles(angles));
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(back[axis], angles[axis], 1e-9);
  }
}

TEST(EzTree, TurnsTowardADirectionByTheGivenAngle) {
  const EzTurn up, aside = turn_from_up({1, 0, 0});
  EXPECT_NEAR(frame_of(aside).heading.x, 1, 1e-12);
  EXPECT_NEAR(frame_of(toward(up, aside, 0.25)).heading.y, std::cos(0.25), 1e-12);
  EXPECT_NEAR(frame_of(toward(up, aside, -0.25)).heading.x, -std::sin(0.25), 1e-12);
  EXPECT_NEAR(frame_of(toward(up, aside, 9)).heading.x, 1, 1e-12) << "not beyond it";
  EXPECT_NEAR(frame_of(turn_from_up({0, -1, 0})).heading.y, -1, 1e-12);
}

TEST(EzTree, ContinuesEachLimbInALimbOfTheNextLevel) {
  const Skeletons tree(ez_tree(), 3);
  const Limbs& limbs = tree.limbs();
  std::size_t continued = 0;
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const std::uint32_t parent = limbs.parent[i];
    if (limbs.starts_limb[i] || limbs.order[i] == limbs.order[parent]) continue;
    ++continued;
    EXPECT_EQ(limbs.order[i], limbs.order[parent] + 1);
    EXPECT_FLOAT_EQ(limbs.base_radius[i], limbs.radius[parent]);
  }
  EXPECT_EQ(continued, 1U + 8U + 64U) << "the trunk, 7 + 1 limbs, and 7 + 1 limbs of each";
}

TEST(EzTree, OfEvergreenFormEndsInPoints) {
  TreeParams params = ez_tree();
  params.ez_tree.evergreen = true;
  params.ez_tree.levels = 1;
  const Skeletons tree(params, 3);
  EXPECT_EQ(tree.limbs().order.size(), tree.limbs().size());
  EXPECT_NEAR(tree.limbs().radius[tree.limbs().size() - 1], 0.2 * 0.001, 1e-9);
  EXPECT_EQ(tree.organs().organ.size(), 7U) << "no leaf at the tip";
}

}  // namespace
}  // namespace seedmesh::tree
