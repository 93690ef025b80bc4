/// The grown presets against measured trees: 12,796 amenity trees of single stem (OpenBARD inventory, quantiles by
/// species), angles of branches, azimuths of limbs (Beyer et al., 2020: uniform round the trunk) and the exponent of
/// widths (Eloy, 2011: 1.8 to 2.3; the authors' own model 2.6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/generators/tree/grown.h"
#include "tests/core/tree/support.h"

namespace seedmesh::tree {
namespace {

constexpr std::uint64_t seeds = 20;

TreeParams species(const std::string& name) {
  TreeParams params = parameters_of_preset(name);
  params.roots.count = 0;
  return params;
}

struct Size {
  double height = 0, crown = 0, diameter = 0, lowest = 0;
};

/// Diameter of the trunk at 1.3 m: limb 0 is a chain of joints that comes first.
double diameter_at_breast(const Limbs& limbs) {
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const glm::vec3 low = limbs.position[limbs.parent[i]], high = limbs.position[i];
    if (limbs.order[i] > 0 || high.y < 1.3F || low.y > 1.3F) continue;
    const float share = (1.3F - low.y) / (high.y - low.y);
    return 2 * static_cast<double>(limbs.base_radius[i] + share * (limbs.radius[i] - limbs.base_radius[i]));
  }
  return 0;
}

Size size_of(const Skeletons& tree) {
  Size size;
  glm::vec3 low{1e9F}, high{-1e9F};
  for (const Organ& leaf : tree.organs().organ) {
    const glm::vec3 tip = leaf.position + leaf.frame * glm::vec3(0, leaf.scale.y, 0);
    low = glm::min(low, glm::min(leaf.position, tip));
    high = glm::max(high, glm::max(leaf.position, tip));
  }
  size.height = static_cast<double>(high.y);
  size.crown = static_cast<double>(high.x - low.x + high.z - low.z) / 2;
  size.lowest = static_cast<double>(low.y);
  size.diameter = diameter_at_breast(tree.limbs());
  return size;
}

struct Band {
  double low = 0, high = 0;
};
struct Measured {
  const char* name = nullptr;
  Band crown_by_height, height_by_diameter, crown_by_diameter;
};

// 10 % and 90 % quantiles: Quercus robur, Betula pendula, Pinus sylvestris.
constexpr Measured measured[] = {
    {"grown_oak", {0.51, 1.25}, {14, 43}, {13, 31}},
    {"grown_birch", {0.36, 0.90}, {28, 69}, {17, 39}},
    {"grown_pine", {0.33, 0.86}, {19, 45}, {11, 25}},
};

void expect_in(double value, const Band& band, const char* what) {
  EXPECT_GE(value, band.low) << what;
  EXPECT_LE(value, band.high) << what;
}

TEST(GrownSpecies, HaveTheProportionsOfRealTrees) {
  for (const Measured& each : measured) {
    const TreeParams params = species(each.name);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(each.name) + " seed " + std::to_string(seed));
      const Size size = size_of(Skeletons(params, seed));
      expect_in(size.crown / size.height, each.crown_by_height, "crown by height");
      expect_in(size.height / size.diameter, each.height_by_diameter, "height by diameter");
      expect_in(size.crown / size.diameter, each.crown_by_diameter, "crown by diameter");
      EXPECT_GE(size.lowest, 0.1);
    }
  }
}

TEST(GrownSpecies, AreTreesForEachAllocationWithoutOtherParameters) {
  // Crown width by height: the 10 % quantile of all species, and the 90 % quantile of the widest one, Prunus avium.
  constexpr Band all_species{0.44, 1.46};
  for (const TreeAllocation allocation : {TreeAllocation::borchert_honda, TreeAllocation::priority}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      TreeParams params;
      params.model = TreeModel::grown;
      params.grown.allocation = allocation;
      SCOPED_TRACE(std::to_string(static_cast<int>(allocation)) + ", seed " + std::to_string(seed));
      const Skeletons tree(params, seed);
      const Size size = size_of(tree);
      expect_in(size.crown / size.height, all_species, "crown by height");
      EXPECT_LE(size.lowest, 0.5 * size.height) << "leaves at the top alone";
      EXPECT_GE(tree.organs().organ.size(), 1000U);
    }
  }
}

/// Calls body(joint, parent) for the first joint of each limb on the trunk.
template <class Body>
void each_branch(const Limbs& limbs, const Body& body) {
  for (std::size_t i = 1; i < limbs.size(); ++i)
    if (limbs.starts_limb[i] && limbs.order[i] == 1) body(i, limbs.parent[i]);
}

TEST(GrownSpecies, HaveLimbsAtAllAzimuths) {
  for (const Measured& each : measured) {
    const TreeParams params = species(each.name);
    double x = 0, z = 0, count = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Skeletons tree(params, seed);
      each_branch(tree.limbs(), [&](std::size_t joint, std::size_t parent) {
        const glm::vec3 step = tree.limbs().position[joint] - tree.limbs().position[parent];
        const double length = std::hypot(static_cast<double>(step.x), static_cast<double>(step.z));
        if (length < 1e-6) return;
        x += static_cast<double>(step.x) / length;
        z += static_cast<double>(step.z) / length;
        ++count;
      });
    }
    // Rayleigh test: p > 0.05 where count r^2 < 3.
    EXPECT_GT(count, 20) << each.name;
    EXPECT_LT((x * x + z * z) / count, 3) << each.name;
  }
}

TEST(GrownSpecies, HaveTheBranchAnglesOfTheirKind) {
  // Median angle of limbs to the trunk: 40 to 70 for spruce (Fabrika), 41 to 43 for chestnut; pines up to 80.
  for (const Measured& each : measured) {
    const Skeletons tree(species(each.name), 1);
    std::vector<double> angles;
    each_branch(tree.limbs(), [&](std::size_t joint, std::size_t parent) {
      const glm::dvec3 step = glm::dvec3(tree.limbs().position[joint] - tree.limbs().position[parent]);
      angles.push_back(math::degrees(math::acos(step.y / std::sqrt(glm::dot(step, step)))));
    });
    std::sort(angles.begin(), angles.end());
    ASSERT_GT(angles.size(), 5U) << each.name;
    EXPECT_GE(angles[angles.size() / 2], 30) << each.name;
    EXPECT_LE(angles[angles.size() / 2], 85) << each.name;
  }
}

TEST(GrownSpecies, HaveTheWidthExponentOfRealTrees) {
  for (const Measured& each : measured) {
    const TreeParams params = species(each.name);
    EXPECT_GE(params.grown.radius_exponent, 1.8) << each.name;
    EXPECT_LE(params.grown.radius_exponent, 2.6) << each.name;
  }
}

}  // namespace
}  // namespace seedmesh::tree
