#include "core/geom/lod/coarse_limbs.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "core/geom/plant/graft/graft.h"
#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Job job_of() { return Job(1, Job::Options{}); }

/// A trunk of ten pieces, straight but for a knee in the middle, with a thick limb and twigs. `wave` bends it
/// to and fro.
Limbs small_tree(const Job& job, float wave = 0) {
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  for (int i = 1; i <= 10; ++i) {
    const auto height = static_cast<float>(i);
    const float radius = 0.4F - 0.03F * height;
    trunk = maker.grow(trunk, {i <= 5 ? 0.2F * height : 2 - 0.2F * height, height, i % 2 == 0 ? wave : 0},
                       {radius + 0.03F, radius});
    if (i == 3) maker.branch(trunk, {-3, 5, 0}, {0.15F, 0.05F});
    if (i > 5) maker.branch(trunk, {2, height + 0.2F * height, 0}, {0.01F, 0.005F});
  }
  return std::move(maker.limbs);
}

CoarseOptions wanting(std::uint64_t triangles) {
  CoarseOptions options;
  options.triangles = triangles;
  return options;
}

TEST(Coarsen, KeepsEverythingWithinTheBudget) {
  Job job = job_of();
  const Limbs limbs = small_tree(job, 0.1F);
  const CoarseLimbs kept = coarsen(limbs, wanting(100'000), job);
  ASSERT_EQ(kept.limbs.size(), limbs.size());
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    EXPECT_EQ(kept.limbs.position[i], limbs.position[kept.was[i]]);
    EXPECT_EQ(kept.limbs.starts_limb[i], limbs.starts_limb[kept.was[i]]);
    if (limbs.parent[kept.was[i]] != Limbs::none) {
      EXPECT_EQ(kept.was[kept.limbs.parent[i]], limbs.parent[kept.was[i]]);
    }
  }
}

TEST(Coarsen, KeepsTheKneeAndTheThickLimbAndStraightensTheRest) {
  Job job = job_of();
  const CoarseLimbs kept = coarsen(small_tree(job), wanting(66), job);
  std::vector<float> rings;
  std::size_t limbs = 0;
  for (std::size_t i = 0; i < kept.limbs.size(); ++i) {
    if (kept.limbs.starts_limb[i]) {
      ++limbs;
      EXPECT_FLOAT_EQ(kept.limbs.position[i].x, -3);
    } else {
      rings.push_back(kept.limbs.position[i].y);
    }
  }
  EXPECT_EQ(limbs, 1U);
  // The third stays for the limb that leaves there, on the straight line.
  EXPECT_THAT(rings, ElementsAre(0, testing::FloatNear(3, 1e-5F), 5, 10));
}

TEST(Coarsen, MakesAboutAsManyTrianglesAsAreWanted) {
  Job job = job_of();
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const Limbs limbs = random_limbs(job, seed);
    const SkinOptions finest{.adapt = true};
    CoarseOptions options = wanting(skin_count(limbs, finest, job).triangles / 2);
    options.skin = &finest;
    const CoarseLimbs kept = coarsen(limbs, options, job);
    SkinOptions coarse = finest;
    coarse.corners = kept.corners;
    for (const Bark& bark : skin(kept.limbs, coarse, job)) EXPECT_THAT(faults(bark.mesh), IsEmpty());
    EXPECT_LE(skin_count(kept.limbs, coarse, job).triangles, skin_count(limbs, finest, job).triangles)
        << seed;
  }
}

TEST(Coarsen, GivesSkinLimbsOfFewerCornersThatAreClosed) {
  Job job = job_of();
  std::uint64_t of_fewer = 0;
  for (std::uint64_t seed = 1; seed < 600; ++seed) {
    const Limbs limbs = random_limbs(job, seed);
    SkinOptions finest{.sides = 3 + static_cast<int>(seed % 8), .stacks = 1 + static_cast<int>(seed % 3)};
    CoarseOptions options = wanting(skin_count(limbs, finest, job).triangles * (1 + seed % 4) / 5);
    options.skin = &finest;
    const CoarseLimbs kept = coarsen(limbs, options, job);
    SkinOptions coarse = finest;
    coarse.corners = kept.corners;
    std::uint64_t made = 0;
    const std::vector<Bark> barks = skin(kept.limbs, coarse, job);
    std::vector<const Mesh*> meshes;
    for (const Bark& bark : barks) {
      made += bark.mesh.elements();
      meshes.push_back(&bark.mesh);
      EXPECT_THAT(faults(bark.mesh), IsEmpty()) << seed;
    }
    EXPECT_EQ(measure(meshes).open_edges, 0U) << seed;
    EXPECT_EQ(made, skin_count(kept.limbs, coarse, job, RepeatMode::found).triangles) << seed;
    for (const LimbCorners& corners : kept.corners) of_fewer += corners.current < corners.finest ? 1 : 0;
  }
  EXPECT_GT(of_fewer, 1000U);
}

TEST(Coarsen, HasNoRingWhereASideBranchLeavesAStraightLimb) {
  Job job = job_of();
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  for (int i = 1; i <= 8; ++i) {
    trunk = maker.grow(trunk, {0, static_cast<float>(i), 0}, {0.1F, 0.1F});
    if (i < 8) maker.branch(trunk, {1, static_cast<float>(i) + 0.5F, 0}, {0.05F, 0.05F});
  }
  const SkinOptions finest{.sides = 6};
  const std::uint64_t whole = skin_count(maker.limbs, finest, job).triangles;
  CoarseOptions options = wanting(whole);
  options.skin = &finest;
  const CoarseLimbs kept = coarsen(maker.limbs, options, job);
  SkinOptions coarse = finest;
  coarse.corners = kept.corners;
  // Seven rings of the trunk less, 12 triangles each, and two for the face that each of eight limbs begins
  // with.
  EXPECT_EQ(skin_count(kept.limbs, coarse, job).triangles, whole - 7 * 12 - 8 * 2);
  for (const Bark& bark : skin(kept.limbs, coarse, job)) {
    EXPECT_THAT(faults(bark.mesh), IsEmpty());
    EXPECT_EQ(measure({&bark.mesh}).open_edges, 0U);
  }
}

TEST(Coarsen, KeepsALimbThatKeepsItsCorners) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {0.1F, 0.1F});
  const SkinOptions finest{.sides = 6};
  CoarseOptions options = wanting(1000);
  options.skin = &finest;
  const CoarseLimbs kept = coarsen(maker.limbs, options, job);
  SkinOptions coarse = finest;
  coarse.corners = kept.corners;
  const Mesh before = std::move(skin(maker.limbs, finest, job)[0].mesh),
             after = std::move(skin(kept.limbs, coarse, job)[0].mesh);
  const auto has = [&](const glm::vec3& place) {
    return std::any_of(before.position.begin(), before.position.end(),
                       [&](const glm::vec3& other) { return glm::distance(place, other) < 1e-6F; });
  };
  for (const glm::vec3& place : after.position) EXPECT_TRUE(has(place));
}

TEST(Coarsen, LeavesABarkThatIsClosed) {
  Job job = job_of();
  const Limbs limbs = small_tree(job);
  const std::size_t whole = graft(limbs, {}, job).elements();
  std::size_t before = whole + 1;
  for (std::uint64_t triangles = whole; triangles > 20; triangles = triangles * 2 / 3) {
    const Mesh mesh = graft(coarsen(limbs, wanting(triangles), job).limbs, {.pointed = true}, job);
    EXPECT_THAT(faults(mesh), IsEmpty());
    EXPECT_EQ(measure({&mesh}).open_edges, 0U);
    EXPECT_LE(mesh.elements(), before);
    before = mesh.elements();
  }
  EXPECT_LT(6 * before, whole);
}

TEST(Coarsen, KeepsTheApparentWidthOfLimbsWithFewerCorners) {
  Job job = job_of();
  const Limbs limbs = small_tree(job);
  CoarseOptions options = wanting(100'000);
  options.sides = 3;
  options.finest_sides = 32;
  const CoarseLimbs kept = coarsen(limbs, options, job);
  // The circumference of a triangle and of 32 corners, of one radius.
  EXPECT_NEAR(kept.limbs.base_radius[1] / limbs.base_radius[1], 3.1365 / 2.5981, 1e-3);
}

TEST(Coarsen, KeepsWhereBonesChange) {
  Job job = job_of();
  const Limbs limbs = small_tree(job);
  std::vector<std::uint16_t> bones(limbs.size(), 0);
  for (std::size_t i = 0; i < limbs.size(); ++i) bones[i] = limbs.position[i].y > 2.5F ? 1 : 0;
  CoarseOptions options = wanting(1);
  options.bones = bones;
  const CoarseLimbs kept = coarsen(limbs, options, job);
  bool has_border = false;
  for (const std::uint32_t joint : kept.was) has_border = has_border || limbs.position[joint].y == 2;
  EXPECT_TRUE(kept.limbs.size() == 0 || has_border);
}

}  // namespace
}  // namespace seedmesh
