#include "core/generators/tree/proctree.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/schema/json.h"
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

TEST(Proctree, FollowsTheClimbRateAndTheTaperRate) {
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

/// What proctree.js (supereggbert/proctree.js, 2017) makes of a preset: the number of heads of branches, the highest
/// of them, the sum of their positions, and the sum of x y + 2 y z + 3 z x.
struct Original {
  int preset;
  int seed;
  std::size_t heads;
  double height;
  glm::dvec3 sum;
  double products;
};
constexpr Original originals[] = {
    {0, 262, 447, 5.582893, {-109.075033, 1792.082911, -36.030569}, -797.091891},
    {1, 861, 383, 5.240832, {-49.063019, 1398.667355, 4.567808}, -119.092480},
    {2, 152, 447, 5.226845, {20.353278, 1890.325803, 65.707384}, 548.326852},
    {3, 499, 447, 5.624234, {-56.469257, 1913.302724, -28.680402}, -565.180670},
    {4, 267, 223, 5.385042, {-12.105041, 845.621194, -7.343204}, -12.077210},
    {5, 519, 447, 5.613061, {22.413312, 1664.166832, -60.812687}, -651.027634},
    {6, 152, 447, 5.458860, {43.960039, 1918.102648, -92.091715}, -596.356787},
    {7, 267, 223, 5.696123, {-22.189246, 813.792107, -16.731458}, -222.356336},
};

TreeParams preset(const Original& row) {
  const std::string path = std::string(SEEDMESH_SOURCE_DIR "/api_schema/presets/tree/proctree_") +
                           std::to_string(row.preset) + ".json";
  std::ifstream file(path);
  IssueList errors;
  TreeParams params = read_tree(Json::parse(file).at("parameters"), "", errors);
  EXPECT_TRUE(errors.empty()) << path;
  params.mSeed = row.seed;
  return params;
}

TEST(Proctree, HasTheBranchesOfTheOriginalInItsSequence) {
  for (const Original& row : originals) {
    TreeParams params = preset(row);
    params.sequence = TreeSequence::original;
    const Skeletons tree(params, 7);
    const Limbs& limbs = tree.limbs();
    ASSERT_EQ(limbs.size(), row.heads + 1) << "and the foot";
    double height = 0, products = 0;
    glm::dvec3 sum(0);
    for (const glm::vec3& head : limbs.position) {
      const glm::dvec3 p(head);
      height = std::max(height, p.y);
      sum += p;
      products += p.x * p.y + 2 * p.y * p.z + 3 * p.z * p.x;
    }
    const double each = 1e-6 * static_cast<double>(row.heads);
    EXPECT_NEAR(height, row.height, 2e-6) << row.preset;
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis], row.sum[axis], each) << row.preset;
    EXPECT_NEAR(products, row.products, 20 * each) << row.preset;
  }
}

TEST(Proctree, IsAsHighAsTheOriginalWithOtherRandomNumbers) {
  for (const Original& row : originals) {
    double height = 0;
    constexpr int seeds = 40;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Skeletons tree(preset(row), seed);
      float highest = 0;
      for (const glm::vec3& head : tree.limbs().position) highest = std::max(highest, head.y);
      height += static_cast<double>(highest) / seeds;
    }
    EXPECT_NEAR(height / row.height, 1, 0.05) << row.preset;
  }
}

TEST(Proctree, IgnoresTheSeedOfTheRequestInItsOwnSequence) {
  TreeParams params = proctree(5, 5);
  params.sequence = TreeSequence::original;
  EXPECT_EQ(Skeletons(params, 1).tips(), Skeletons(params, 2).tips());
  params.mSeed = 263;
  EXPECT_NE(Skeletons(params, 1).tips(), Skeletons(proctree(5, 5), 1).tips());
}

TEST(Proctree, DiffersFromSeedToSeed) {
  EXPECT_NE(Skeletons(proctree(5, 5), 1).tips(), Skeletons(proctree(5, 5), 2).tips());
}

}  // namespace
}  // namespace seedmesh::tree
