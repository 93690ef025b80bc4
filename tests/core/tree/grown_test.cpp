/// The model grown against Palubicki et al. (2009): how light and vigour flow, closed forms of the pipe model, and what
/// each parameter does.
#include "core/generators/tree/grown.h"

#include <gmock/gmock.h>

#include <functional>

#include "core/generators/tree/grown_vigour.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

TreeParams grown_for(double years) {
  TreeParams params;
  params.model = TreeModel::grown;
  params.mature_age = years;
  return params;
}

/// A trunk of one internode with a bud at its end and side buds there, each with its light.
GrownPlant fork(double ahead, const std::vector<double>& aside, const Job& job) {
  GrownPlant plant(job);
  GrownNode root, node;
  node.parent = 0;
  node.continues = true;
  plant.nodes.push_back(root);
  plant.nodes.push_back(node);
  plant.axes = 1;
  GrownBud bud;
  bud.node = 1;
  bud.ends_axis = true;
  bud.light = ahead;
  plant.buds.push_back(bud);
  for (const double light : aside) {
    bud.ends_axis = false;
    bud.light = light;
    plant.buds.push_back(bud);
  }
  return plant;
}

std::vector<double> vigour_of_buds(const GrownPlant& plant) {
  std::vector<double> vigour;
  for (const GrownBud& bud : plant.buds) vigour.push_back(bud.vigour);
  return vigour;
}

TEST(Grown, DividesVigourByLambdaAndLight) {
  const Job job(1, Job::Options{});
  GrownPlant plant = fork(0.5, {0.25, 0.5}, job);
  gather_light(plant, 0);
  EXPECT_EQ(plant.nodes[0].light, 1.25);
  EXPECT_EQ(plant.nodes[0].count, 2U);
  divide_by_lambda(plant, 2, 0.6);
  // 2 x 1.25 = 2.5; ahead 0.6 x 0.5 / (0.6 x 0.5 + 0.4 x 0.75) = 1/2, the sides share the rest as 1 to 2.
  EXPECT_THAT(vigour_of_buds(plant),
              ElementsAre(DoubleNear(1.25, 1e-12), DoubleNear(1.25 / 3, 1e-12), DoubleNear(2.5 / 3, 1e-12)));
}

TEST(Grown, DividesVigourByRank) {
  Job job(1, Job::Options{});
  GrownPlant plant = fork(0.5, {1, 0.25}, job);
  gather_light(plant, 0);
  TreeGrown grown;
  grown.alpha = 1;
  grown.priority_least = 0.2;
  grown.priority_share = 1;
  divide_by_priority(plant, grown, job);
  // Ranks by light: 1, 0.5, 0.25 with weights 1, 0.6, 0.2, so the shares are as 1 to 0.3 to 0.05.
  EXPECT_THAT(vigour_of_buds(plant),
              ElementsAre(DoubleNear(1.75 * 0.3 / 1.35, 1e-12), DoubleNear(1.75 / 1.35, 1e-12),
                          DoubleNear(1.75 * 0.05 / 1.35, 1e-12)));
}

TEST(Grown, ChangesLambdaBetweenTwoYears) {
  TreeGrown grown;
  grown.lambda = 0.6;
  grown.lambda_old = 0.5;
  grown.lambda_years = {10, 20};
  EXPECT_EQ(lambda_in(grown, 10), 0.6);
  EXPECT_NEAR(lambda_in(grown, 15), 0.55, 1e-12);
  EXPECT_EQ(lambda_in(grown, 30), 0.5);
}

/// The sum of the nth powers of the radii that leave a joint.
std::vector<double> carried(const Limbs& limbs, double exponent) {
  std::vector<double> sum(limbs.size(), 0);
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const double radius = limbs.starts_limb[i] ? limbs.base_radius[i] : limbs.radius[i];
    sum[limbs.parent[i]] += std::pow(radius, exponent);
  }
  return sum;
}

TEST(Grown, KeepsTheSumOfThePowersOfRadiiAtForks) {
  TreeParams params = grown_for(8);
  params.grown.shed = 0;
  params.grown.takeover = 0;
  params.grown.bud_years = 100;
  params.grown.light.shade = 0.01;  // All buds have light, so no branch is shed.
  const Skeletons tree(params, 3);
  const std::vector<double> sum = carried(tree.limbs(), params.grown.radius_exponent);
  std::size_t forks = 0;
  for (std::size_t i = 1; i < tree.limbs().size(); ++i) {
    if (sum[i] == 0) continue;
    ++forks;
    const double own = std::pow(static_cast<double>(tree.limbs().radius[i]), params.grown.radius_exponent);
    EXPECT_NEAR(own, sum[i], 1e-3 * own);
  }
  EXPECT_GT(forks, 20U);
}

double width_at(const Skeletons& tree, double low, double high) {
  double width = 0;
  for (const glm::vec3& each : tree.limbs().position) {
    const glm::dvec3 at(each);
    if (at.y >= low && at.y <= high) width = std::max(width, std::hypot(at.x, at.z));
  }
  return width;
}

/// What a change of the parameters has to change.
bool differs(const TreeParams& a, const TreeParams& b) {
  const Skeletons first(a, 3), second(b, 3);
  const auto bytes = [](const Skeletons& tree) {
    std::vector<float> values;
    for (const glm::vec3& each : tree.limbs().position) values.insert(values.end(), {each.x, each.y, each.z});
    for (const float each : tree.limbs().radius) values.push_back(each);
    for (const Organ& each : tree.organs().organ)
      values.insert(values.end(), {each.position.x, each.frame.w, each.scale.x, each.scale.y});
    return values;
  };
  return bytes(first) != bytes(second);
}

TEST(Grown, EveryParameterHasAnEffect) {
  struct Change {
    const char* name;
    std::function<void(TreeGrown&)> make;
  };
  const Change changes[] = {
      {"internode", [](TreeGrown& g) { g.internode = 0.4; }},
      {"alpha", [](TreeGrown& g) { g.alpha = 1.5; }},
      {"longest_shoot", [](TreeGrown& g) { g.longest_shoot = 1; }},
      {"allocation", [](TreeGrown& g) { g.allocation = TreeAllocation::priority; }},
      {"lambda", [](TreeGrown& g) { g.lambda = 0.6; }},
      {"lambda_old", [](TreeGrown& g) { g.lambda_old = 0.45; }},
      {"lambda_years",
       [](TreeGrown& g) {
         g.lambda_years = {2, 4};
       }},
      {"light.cell", [](TreeGrown& g) { g.light.cell = 0.5; }},
      {"light.shade", [](TreeGrown& g) { g.light.shade = 0.1; }},
      {"light.falloff", [](TreeGrown& g) { g.light.falloff = 1.5; }},
      {"light.layers", [](TreeGrown& g) { g.light.layers = 3; }},
      {"perception_distance", [](TreeGrown& g) { g.perception_distance = 3; }},
      {"perception_angle", [](TreeGrown& g) { g.perception_angle = 40; }},
      {"bud_years", [](TreeGrown& g) { g.bud_years = 1; }},
      {"takeover", [](TreeGrown& g) { g.takeover = 0.5; }},
      {"levels", [](TreeGrown& g) { g.levels = 2; }},
      {"shed", [](TreeGrown& g) { g.shed = 0.6; }},
      {"shed_years", [](TreeGrown& g) { g.shed_years = 7; }},
      {"radius_exponent", [](TreeGrown& g) { g.radius_exponent = 2; }},
      {"tip_radius", [](TreeGrown& g) { g.tip_radius = 0.004; }},
      {"clearance", [](TreeGrown& g) { g.clearance = 2; }},
      {"leaves", [](TreeGrown& g) { g.leaves = 1; }},
      {"leaf_years", [](TreeGrown& g) { g.leaf_years = 1; }},
      {"leaf_length", [](TreeGrown& g) { g.leaf_length = 0.1; }},
      {"leaf_width", [](TreeGrown& g) { g.leaf_width = 1; }},
      {"leaf_angle", [](TreeGrown& g) { g.leaf_angle = 20; }},
      {"leaf_bend", [](TreeGrown& g) { g.leaf_bend = 0; }},
      {"obstacles",
       [](TreeGrown& g) {
         g.obstacles = {{TreeObstacleShape::box, {1, 0, 0}, {1, 9, 9}}};
       }},
      {"neighbours",
       [](TreeGrown& g) {
         g.neighbours = {{{1, 0}}};
       }},
      {"level.angle", [](TreeGrown& g) { g.level[0].angle = 70; }},
      {"level.angle_spread", [](TreeGrown& g) { g.level[0].angle_spread = 30; }},
      {"level.buds", [](TreeGrown& g) { g.level[0].buds = 2; }},
      {"level.whorl", [](TreeGrown& g) { g.level[0].whorl = 5; }},
      {"level.phyllotaxis", [](TreeGrown& g) { g.level[0].phyllotaxis = 90; }},
      {"level.phyllotaxis_spread", [](TreeGrown& g) { g.level[0].phyllotaxis_spread = 60; }},
      // A leader in full light has no direction of more light.
      {"level.light", [](TreeGrown& g) { g.level[1].light = 0; }},
      {"level.tropism", [](TreeGrown& g) { g.level[0].tropism = 0.5; }},
      {"level.level_out", [](TreeGrown& g) { g.level[1].level_out = 0.5; }},
      {"level.wander", [](TreeGrown& g) { g.level[0].wander = 0; }},
      {"level.length", [](TreeGrown& g) { g.level[1].length = 0.5; }},
  };
  TreeParams base = grown_for(12);
  base.grown.level.resize(2);
  for (const Change& change : changes) {
    TreeParams changed = base;
    change.make(changed.grown);
    EXPECT_TRUE(differs(base, changed)) << change.name;
  }
}

TEST(Grown, KeepsShootsAboveTheClearance) {
  TreeParams params = grown_for(14);
  params.grown.level.resize(2);
  params.grown.level[1].tropism = -0.8;
  params.grown.clearance = 1;
  const Skeletons tree(params, 2);
  float lowest = 1e9F;
  for (std::size_t i = 0; i < tree.limbs().size(); ++i) {
    if (tree.limbs().order[i] > 0) lowest = std::min(lowest, tree.limbs().position[i].y);
  }
  EXPECT_GT(lowest, 0.9F);
}

TEST(Grown, GrowsAroundObstacles) {
  TreeParams params = grown_for(16);
  params.grown.obstacles = {{TreeObstacleShape::box, {2, 0, 0}, {2, 30, 30}}};
  const Skeletons tree(params, 2);
  float most = 0;
  for (const glm::vec3& each : tree.limbs().position) most = std::max(most, each.x);
  EXPECT_LT(most, 1.05F);
  EXPECT_GT(width_at(tree, 0, 30), 1.3);
}

TEST(Grown, GrowsAwayFromANeighbour) {
  TreeParams params = grown_for(18);
  params.grown.neighbours = {{{1.5, 0}}};
  double beside = 0, away = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Skeletons tree(params, seed);
    for (const glm::vec3& each : tree.limbs().position)
      (each.x > 0 ? beside : away) += std::abs(static_cast<double>(each.x));
  }
  EXPECT_LT(beside, 0.8 * away);
}

TEST(Grown, IsTheYoungTreeAtItsAge) {
  TreeParams young = grown_for(9), old = grown_for(20);
  old.age = 9;
  EXPECT_FALSE(differs(young, old));
  // Within a year, shoots grow from the form of the year before.
  old.age = 9.001;
  const Skeletons before(young, 3), after(old, 3);
  const Box low = bounds_of(before.limbs().position.span()), high = bounds_of(after.limbs().position.span());
  EXPECT_NEAR(low.max.y, high.max.y, 0.02);
  EXPECT_NEAR(low.max.x, high.max.x, 0.1);
}

TEST(Grown, ShedsBranchesInTheShade) {
  TreeParams params = grown_for(25);
  const auto low_branches = [&] {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Skeletons tree(params, seed);
      const Limbs& limbs = tree.limbs();
      for (std::size_t i = 1; i < limbs.size(); ++i)
        count += limbs.starts_limb[i] && limbs.position[limbs.parent[i]].y < 4 ? 1 : 0;
    }
    return count;
  };
  params.grown.shed = 0.1;
  const int kept = low_branches();
  params.grown.shed = 0.5;
  EXPECT_LT(4 * low_branches(), 3 * kept);
}

TEST(Grown, BendsALeaderAwayFromTheShade) {
  TreeParams params = grown_for(12);
  params.grown.level.resize(1);
  params.grown.level[0].wander = 0;
  params.grown.obstacles = {{TreeObstacleShape::box, {0.7, 4, 0}, {1.6, 0.5, 8}}};
  const auto highest = [&](double weight) {
    params.grown.level[0].light = weight;
    const Skeletons tree(params, 1);
    const Limbs& limbs = tree.limbs();
    glm::vec3 top{0};
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.order[i] == 0 && limbs.position[i].y > top.y) top = limbs.position[i];
    }
    return top;
  };
  EXPECT_LT(highest(1).x, highest(0).x - 0.2F);
}

TEST(Grown, SpendsInternodesBeforeTheyGrow) {
  Job::Options options;
  options.limits.modules = 500;
  Job job(1, options);
  try {
    skeleton_of(grown_for(40), 1, job);
    FAIL() << "expected a Stop";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::limit);
  }
}

TEST(Grown, EndsAtTheDeadline) {
  Job::Options options;
  options.deadline = Job::Clock::now();
  Job job(1, options);
  EXPECT_THROW(skeleton_of(grown_for(40), 1, job), Stop);
}

TEST(Grown, TakesTheMemoryOfItsGridFromTheBudget) {
  TreeParams params = grown_for(3);
  params.grown.internode = 5;
  params.grown.light.cell = 0.02;
  Job::Options options;
  options.limits.memory_bytes = 64U << 20U;
  Job job(1, options);
  EXPECT_THROW(skeleton_of(params, 1, job), Stop);
}

}  // namespace
}  // namespace seedmesh::tree
