/// Several trunks, whorls, and where limbs begin on their parents.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/generators/tree/weber_penn_shape.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

/// A straight trunk of 10 m with five segments and thin horizontal limbs.
TreeParams pole() {
  TreeParams p;
  p.Levels = 2;
  p.Scale = 10;
  p.ScaleV = 0;
  p.BaseSize = 0;
  p.curve_res_0 = 5;
  p.curve_0 = p.curve_v_0 = p.curve_back_0 = 0;
  p.length_v_0 = 0;
  p.Leaves = 0;
  p.branches_1 = 30;
  p.down_angle_1 = 90;
  p.down_angle_v_1 = 0;
  p.curve_1 = p.curve_v_1 = p.curve_back_1 = 0;
  return p;
}

/// Heights at which limbs of level 1 leave the trunk, rising.
std::vector<double> feet(const TreeParams& params) {
  const Skeletons made(params, 4);
  const Limbs& limbs = made.limbs();
  std::vector<double> heights;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.starts_limb[i] && limbs.order[i] == 1)
      heights.push_back(static_cast<double>(limbs.position[limbs.parent[i]].y));
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

TEST(WeberPennStand, HasAsManyTrunksWithinTheDistance) {
  TreeParams p = pole();
  p.branches_0 = 12;
  p.branch_dist_0 = 1.5;
  const Skeletons made(p, 4);
  std::vector<glm::vec3> roots;
  for (std::size_t i = 0; i < made.limbs().size(); ++i) {
    if (made.limbs().parent[i] == Limbs::none) roots.push_back(made.limbs().position[i]);
  }
  ASSERT_EQ(roots.size(), 12U);
  double widest = 0;
  for (const glm::vec3& root : roots) {
    EXPECT_EQ(root.y, 0);
    const double away = std::sqrt(static_cast<double>(root.x * root.x + root.z * root.z));
    EXPECT_LE(away, 1.5);
    widest = std::max(widest, away);
  }
  EXPECT_GT(widest, 0.75) << "twelve uniform numbers are all in the lower half once in 4,096 times";
  EXPECT_EQ(feet(p).size(), 12 * feet(pole()).size());
}

TEST(WeberPennStand, KeepsTheFirstTrunkWhenMoreAreAdded) {
  TreeParams p = pole();
  p.curve_v_0 = 60;
  const Skeletons alone(p, 4);
  p.branches_0 = 3;
  const Skeletons three(p, 4);
  const auto ends = [](const Limbs& limbs) {
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.order[i] == 0) points.push_back(limbs.position[i]);
    }
    return points;
  };
  const std::vector<glm::vec3> one = ends(alone.limbs()), all = ends(three.limbs());
  ASSERT_GT(all.size(), 2 * one.size());
  for (const glm::vec3& point : one) EXPECT_NE(std::find(all.begin(), all.end(), point), all.end());
}

TEST(WeberPennStand, GathersLimbsInWhorls) {
  TreeParams p = pole();
  p.whorl_1 = 5;
  std::map<double, int> at;
  for (const double height : feet(p)) ++at[height];
  EXPECT_EQ(at.size(), 6U);
  for (const auto& [height, count] : at) EXPECT_EQ(count, 5) << height;

  const Skeletons made(p, 4);
  const Limbs& limbs = made.limbs();
  std::map<float, std::vector<double>> angles;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (!limbs.starts_limb[i] || limbs.order[i] != 1) continue;
    const glm::vec3 along = limbs.position[i] - limbs.position[limbs.parent[i]];
    angles[limbs.position[limbs.parent[i]].y].push_back(
        std::atan2(static_cast<double>(along.z), static_cast<double>(along.x)));
  }
  for (auto& [height, around] : angles) {
    std::sort(around.begin(), around.end());
    for (std::size_t i = 1; i < around.size(); ++i)
      EXPECT_NEAR(around[i] - around[i - 1], 2 * math::pi / 5, 1e-3) << height;
  }
}

TEST(WeberPennStand, MovesLimbsTowardTheBeginningOfEachSegment) {
  const std::vector<double> even = feet(pole());
  TreeParams p = pole();
  p.branch_dist_1 = 0.25;
  const std::vector<double> moved = feet(p);
  ASSERT_EQ(moved.size(), even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    const double begin = 2 * std::floor(even[i] / 2);  // segments have 2 m
    EXPECT_NEAR(moved[i], begin + 0.25 * (even[i] - begin), 1e-4) << i;
  }
}

TEST(WeberPennStand, LeavesTheBaseOfALimbBare) {
  TreeParams p = pole();
  p.Levels = 3;
  p.branches_1 = 3;
  p.branches_2 = 20;
  p.curve_2 = p.curve_v_2 = p.curve_back_2 = 0;
  p.base_size_1 = 0.4;
  const Skeletons made(p, 4);
  const Limbs& limbs = made.limbs();
  std::size_t count = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (!limbs.starts_limb[i] || limbs.order[i] != 2) continue;
    // Back to the trunk along the straight limb.
    std::size_t head = limbs.parent[i];
    while (!limbs.starts_limb[head]) head = limbs.parent[head];
    const glm::vec3 foot = limbs.position[limbs.parent[head]];
    const double length = length_from(limbs, head);
    EXPECT_GE(static_cast<double>(glm::distance(limbs.position[limbs.parent[i]], foot)), 0.4 * length - 1e-4);
    ++count;
  }
  EXPECT_GE(count, 20U);
}

TEST(WeberPennStand, TakesZeroSegmentsOfUnusedLevelsAsOne) {
  TreeParams p = pole();
  p.curve_res_3 = 0;
  EXPECT_EQ(feet(p), feet(pole()));
  EXPECT_EQ(weber_penn_levels(p)[3].curve_res, 1);
}

}  // namespace
}  // namespace seedmesh::tree
