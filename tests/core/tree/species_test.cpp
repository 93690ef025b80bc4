/// The four species of the paper, as shipped, against its formulas.
#include <gtest/gtest.h>

#include "core/generators/tree/weber_penn_shape.h"
#include "core/geom/plant/graft/graft.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

/// Every limb of one order: its length, where on its parent's length it stands.
struct Stem {
  double length = 0, parent_length = 0, offset = 0;
};

std::vector<Stem> stems(const Limbs& limbs, int order) {
  std::vector<double> along(limbs.size(), 0);  // from the beginning of the limb
  std::vector<std::size_t> head(limbs.size(), 0);
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const std::uint32_t parent = limbs.parent[i];
    const double length = static_cast<double>(glm::distance(limbs.position[i], limbs.position[parent]));
    const bool begins = limbs.starts_limb[i] || limbs.parent[parent] == Limbs::none;
    head[i] = begins ? i : head[parent];
    along[i] = length + (begins ? 0 : along[parent]);
  }
  std::vector<double> whole(limbs.size(), 0);
  for (std::size_t i = 1; i < limbs.size(); ++i) whole[head[i]] = std::max(whole[head[i]], along[i]);
  std::vector<Stem> out;
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    if (head[i] != i || limbs.order[i] != order) continue;
    const std::uint32_t parent = limbs.parent[i];
    out.push_back({whole[i], parent == 0 ? 0 : whole[head[parent]], along[parent]});
  }
  return out;
}

TEST(Species, HaveTheHeightsOfThePaper) {
  for (const char* name : {"quaking_aspen", "black_tupelo", "weeping_willow", "black_oak"}) {
    const TreeParams params = parameters_of_preset(name);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Skeletons tree(params, seed);
      // Of the trunk alone: clones of a stem that splits begin on it.
      const double length = stems(tree.limbs(), 0).front().length;
      const double low = std::max(0.1 * params.Scale, params.Scale - params.ScaleV) * params.length_0;
      EXPECT_GE(length, low - 1e-3) << name;
      EXPECT_LE(length, (params.Scale + params.ScaleV) * params.length_0 + 1e-3) << name;
      EXPECT_NEAR(static_cast<double>(tree.limbs().base_radius[1]),
                  length * params.Ratio * flared(params.Flare, 0), 1e-3 * length)
          << name;
    }
  }
}

TEST(Species, HaveAsManyLimbsAsTheFormulasGiveWhereStemsDoNotSplit) {
  for (const char* name : {"quaking_aspen", "black_tupelo"}) {
    const TreeParams params = parameters_of_preset(name);
    const Skeletons tree(params, 4);
    const auto levels = weber_penn_levels(params);
    EXPECT_EQ(stems(tree.limbs(), 0).size(), 1U);
    const std::vector<Stem> first = stems(tree.limbs(), 1);
    EXPECT_EQ(first.size(), static_cast<std::size_t>(levels[1].branches)) << name;
    // The longest of a level is drawn once a parent; here it lies within its variation.
    double low = 0, high = 0;
    for (const Stem& each : first) {
      const double share = each.length / each.parent_length;
      low +=
          levels[2].branches * (0.2 + 0.8 * std::min(1.0, share / (levels[1].length + levels[1].length_v)));
      high +=
          levels[2].branches * (0.2 + 0.8 * std::min(1.0, share / (levels[1].length - levels[1].length_v)));
    }
    const std::vector<Stem> second = stems(tree.limbs(), 2);
    const auto rounding = 0.5 * static_cast<double>(first.size());
    EXPECT_GE(static_cast<double>(second.size()), low - rounding) << name;
    EXPECT_LE(static_cast<double>(second.size()), high + rounding) << name;
    if (params.Levels < 4) continue;
    double third = 0;
    for (const Stem& each : second)
      third += levels[3].branches * (1 - 0.5 * each.offset / each.parent_length);
    EXPECT_NEAR(static_cast<double>(stems(tree.limbs(), 3).size()), third,
                0.5 * static_cast<double>(second.size()));
  }
}

TEST(Species, BearLeavesByThePositionOfTheirTwig) {
  for (const char* name : {"quaking_aspen", "black_tupelo"}) {
    const TreeParams params = parameters_of_preset(name);
    const Skeletons tree(params, 4);
    const std::vector<Stem> last = stems(tree.limbs(), params.Levels - 1);
    double leaves = 0;
    for (const Stem& each : last)
      leaves += params.Leaves * shape_ratio(params, 4, each.offset / each.parent_length);
    EXPECT_NEAR(static_cast<double>(tree.organs().organ.size()), leaves,
                0.5 * static_cast<double>(last.size()))
        << name;
  }
}

/// Limbs of one order that grow from one lower, so that clones of a stem, which share its children with it,
/// are counted once.
std::size_t families(const Limbs& limbs, int order) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    if (limbs.starts_limb[i] && limbs.order[i] == order && limbs.order[limbs.parent[i]] < order) ++count;
  }
  return count;
}

TEST(Species, ShareTheChildrenOfAStemAmongItsClones) {
  // The oak is not pruned: its stems bear what the formula says, but for the rounding of each clone's share.
  const TreeParams oak = parameters_of_preset("black_oak");
  const Skeletons tree(oak, 4);
  const auto levels = weber_penn_levels(oak);
  const auto stems_of_trunk = static_cast<double>(stems(tree.limbs(), 0).size());
  const auto first = static_cast<double>(families(tree.limbs(), 1));
  EXPECT_NEAR(first, levels[1].branches, stems_of_trunk);
  // Each limb of the first order bears a fifth of 120 at least and 120 at most, and each twig 25 leaves where
  // it stands at its parent's tip and half as many at its foot.
  const auto second = static_cast<double>(families(tree.limbs(), 2));
  EXPECT_GT(second, 0.2 * levels[2].branches * first);
  EXPECT_LT(second, levels[2].branches * first);
  const auto leaves = static_cast<double>(tree.organs().organ.size());
  EXPECT_GT(leaves, (0.5 * oak.Leaves - 1) * second);
  EXPECT_LT(leaves, (oak.Leaves + 1) * second);
}

TEST(Species, LoseLimbsByPruningAlone) {
  TreeParams willow = parameters_of_preset("weeping_willow");
  const Skeletons pruned(willow, 4);
  willow.PruneRatio = 0;
  const Skeletons free(willow, 4);
  const auto levels = weber_penn_levels(willow);
  const auto stems_of_trunk = static_cast<double>(stems(free.limbs(), 0).size());
  EXPECT_NEAR(static_cast<double>(families(free.limbs(), 1)), levels[1].branches, stems_of_trunk);
  EXPECT_LE(families(pruned.limbs(), 1), families(free.limbs(), 1));
  EXPECT_LT(families(pruned.limbs(), 3), families(free.limbs(), 3));
  const auto last = static_cast<double>(families(pruned.limbs(), 3));
  const auto leaves = static_cast<double>(pruned.organs().organ.size());
  EXPECT_GT(leaves, (0.5 * willow.Leaves - 1) * last);
  EXPECT_LT(leaves, (willow.Leaves + 1) * last);
}

TEST(Species, DivideTheTrunkOfTheWillowAndTheOakAtTheirFirstSegment) {
  for (const char* name : {"weeping_willow", "black_oak"}) {
    const TreeParams params = parameters_of_preset(name);
    EXPECT_EQ(params.base_splits, 2);
    const Skeletons tree(params, 4);
    EXPECT_GE(stems(tree.limbs(), 0).size(), 3U) << "the trunk and its two clones at least";
    EXPECT_GT(tree.organs().organ.size(), 1000U);
  }
}

/// Limbs that are closed where they begin, for want of room, as a share of all.
double closed_share(const std::string& name) {
  const TreeParams params = parameters_of_preset(name);
  Job job(4, Job::Options{});
  const Skeleton skeleton = skeleton_of(params, 4, job);
  GraftOptions options;
  options.sides = params.sides;
  options.thinnest = static_cast<float>(params.twig_radius);
  GraftCounts counts;
  graft(skeleton.limbs, options, job, &counts);
  return static_cast<double>(counts.closed + counts.fallen_back) / counts.limbs;
}

TEST(Species, GrowAlmostAllTheirLimbsOutOfTheirParents) {
  EXPECT_LT(closed_share("quaking_aspen"), 0.06);
  EXPECT_LT(closed_share("birch"), 0.08);
  EXPECT_LT(closed_share("maple"), 0.1);
  EXPECT_LT(closed_share("poplar"), 0.1);
  EXPECT_LT(closed_share("black_tupelo"), 0.12);
  EXPECT_LT(closed_share("black_oak"), 0.2) << "stems that split by ten degrees";
  EXPECT_LT(closed_share("spruce"), 0.3) << "whorls";
}

TEST(Species, KeepTheWillowInsideItsEnvelope) {
  const TreeParams params = parameters_of_preset("weeping_willow");
  const Skeletons tree(params, 4);
  // Twigs of the last level are tried as a whole before they are grown; the trunk is not pruned.
  std::size_t outside = 0, all = 0;
  for (std::size_t i = 1; i < tree.limbs().size(); ++i) {
    if (tree.limbs().order[i] < 1) continue;
    const glm::vec3 p = tree.limbs().position[i];
    ++all;
    if (std::sqrt(p.x * p.x + p.z * p.z) >
        1.02F * static_cast<float>((params.Scale + params.ScaleV) * params.PruneWidth))
      ++outside;
  }
  EXPECT_LT(static_cast<double>(outside), 0.02 * static_cast<double>(all));
}

}  // namespace
}  // namespace seedmesh::tree
