#include "core/geom/lod/detail.h"

#include <gmock/gmock.h>

#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Job job_of() { return Job(1, Job::Options{}); }

TEST(Detail, HasTheSidesAndStacksOfTunnelsTable) {
  std::vector<int> sides, stacks;
  for (int level = 0; level < most_levels; ++level) {
    sides.push_back(Detail(level).sides(32));
    stacks.push_back(Detail(level).stacks(6));
  }
  EXPECT_THAT(sides, ElementsAre(32, 22, 18, 16, 14));
  EXPECT_THAT(stacks, ElementsAre(6, 4, 3, 3, 2));
}

/// A trunk with a thick branch that ends in a twig, and a twig of its own.
Limbs small_tree(const Job& job) {
  SkeletonMaker maker(job);
  const std::uint32_t root = maker.root({0, 0, 0});
  const std::uint32_t trunk = maker.grow(root, {0, 1, 0}, {0.1F, 0.08F});
  const std::uint32_t branch = maker.branch(trunk, {1, 1.5F, 0}, {0.05F, 0.04F});
  maker.branch(branch, {1.5F, 2, 0}, {0.004F, 0.002F});
  maker.branch(trunk, {-0.3F, 1.4F, 0}, {0.004F, 0.002F});
  maker.grow(trunk, {0, 2, 0}, {0.08F, 0.05F});
  return std::move(maker.limbs);
}

TEST(Detail, GivesEveryLevelFewerTriangles) {
  std::uint64_t bare = 1000, hidden = 1000;
  double organs = 1;
  for (int level = 1; level < most_levels; ++level) {
    const Detail detail(level);
    EXPECT_LE(10 * detail.bark(1000, 1), 9 * bare);
    EXPECT_LE(10 * detail.bark(1000, 0), 9 * hidden);
    EXPECT_LE(detail.organs(), 0.9 * organs);
    bare = detail.bark(1000, 1);
    hidden = detail.bark(1000, 0);
    organs = detail.organs();
  }
  EXPECT_EQ(bare, 351U);
  EXPECT_EQ(hidden, 100U);
}

TEST(Detail, GivesTubesThatNothingHidesMoreThanBarkUnderLeaves) {
  for (int level = 1; level < most_levels; ++level) {
    const Detail detail(level);
    EXPECT_GE(detail.tubes(1000), detail.bark(1000, 1));
  }
}

TEST(Detail, LeavesOutWhatIsDrawnTwice) {
  Job job = job_of();
  SkeletonMaker maker(job);
  const std::uint32_t root = maker.root({0, 0, 0});
  const std::uint32_t first = maker.grow(root, {0, 1, 0}, {0.1F, 0.1F});
  const std::uint32_t again = maker.grow(root, {0, 1, 0}, {0.1F, 0.1F});
  maker.grow(again, {1, 2, 0}, {0.05F, 0.05F});
  const KeptLimbs kept = without_repeats(maker.limbs, 8, job);
  ASSERT_EQ(kept.limbs.size(), 3U);
  EXPECT_EQ(kept.new_index[again], Limbs::none);
  EXPECT_EQ(kept.limbs.parent[2], kept.new_index[first]) << "what grew from it grows from the first";
}

TEST(Skin, HasFewerSidesOnThinnerLimbsWhereItAdapts) {
  Job job = job_of();
  const Limbs limbs = small_tree(job);
  const auto even = skin(limbs, {.sides = 24}, job), adapted = skin(limbs, {.sides = 24, .adapt = true}, job);
  EXPECT_THAT(faults(adapted[0].mesh), IsEmpty());
  EXPECT_EQ(measure({&adapted[0].mesh}).open_edges, 0U);
  EXPECT_LT(adapted[0].mesh.elements(), even[0].mesh.elements());
  EXPECT_EQ(sides_of_limb({.sides = 24}, 0.1F, 0.1F), 24);
  EXPECT_EQ(sides_of_limb({.sides = 24}, 0.025F, 0.1F), 12);
  EXPECT_EQ(sides_of_limb({.sides = 24}, 0, 0.1F), 3);
}

}  // namespace
}  // namespace seedmesh
