#include "core/geom/plant/graft/limb_continuation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geom/lod/detail.h"
#include "core/geom/plant/graft/color_split.h"
#include "core/geom/plant/graft/graft.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

/// A trunk that ends in limbs all round, at an angle in degrees.
Limbs crown(const Job& job, int limbs, double lean, float radius) {
  SkeletonMaker maker(job);
  const std::uint32_t top = maker.grow(maker.root({0, 0, 0}), {0, 3, 0}, {0.1F, 0.1F});
  for (int i = 0; i < limbs; ++i) {
    const math::SinCos around = math::sincos_degrees(360.0 * i / limbs), off = math::sincos_degrees(lean);
    const glm::dvec3 along{around.cos * off.sin, off.cos, around.sin * off.sin};
    maker.branch(top, glm::vec3(glm::dvec3(0, 3, 0) + 2.0 * along), {radius, radius});
  }
  return std::move(maker.limbs);
}

GraftCounts counts_of(const Limbs& limbs, Job& job) {
  GraftCounts counts;
  const Mesh mesh = graft(limbs, {}, job, &counts);
  EXPECT_TRUE(faults(mesh).empty());
  EXPECT_EQ(measure({&mesh}).open_edges, 0U);
  return counts;
}

TEST(LimbContinuation, GoOnWhereALimbEndsInBranchesAlone) {
  Job job(1, Job::Options{});
  const Limbs fork = crown(job, 2, 25, 0.08F);
  EXPECT_EQ(counts_of(fork, job).closed, 2U);
  const GraftCounts joined = counts_of(continue_limbs(fork, job).limbs, job);
  EXPECT_EQ(joined.limbs, 2U);
  EXPECT_EQ(joined.forks, 1U);
}

TEST(LimbContinuation, LeaveTheJointInTurnWhereOneForkHasSpace) {
  Job job(1, Job::Options{});
  const ContinuedLimbs three = continue_limbs(crown(job, 3, 30, 0.08F), job);
  EXPECT_EQ(three.limbs.size(), 7U)
      << "a joint before the end of the trunk, and a bend of who leaves it there";
  const GraftCounts counts = counts_of(three.limbs, job);
  EXPECT_EQ(counts.forks, 2U);
  EXPECT_EQ(counts.closed, 0U);
}

TEST(LimbContinuation, NameTheJointOfEach) {
  Job job(1, Job::Options{});
  const Limbs drawn = crown(job, 4, 30, 0.05F);
  const ContinuedLimbs continued = continue_limbs(drawn, job);
  ASSERT_EQ(continued.original.size(), continued.limbs.size());
  std::uint32_t before = 0;
  std::size_t same = 0;
  for (std::size_t i = 0; i < continued.original.size(); ++i) {
    EXPECT_GE(continued.original[i], before) << "joints keep their order";
    before = continued.original[i];
    same += continued.limbs.position[i] == drawn.position[continued.original[i]] ? 1U : 0U;
    if (continued.limbs.parent[i] != Limbs::none) {
      EXPECT_LT(continued.limbs.parent[i], i);
    }
  }
  EXPECT_EQ(same, drawn.size()) << "and their places";
}

TEST(LimbContinuation, AreNeitherThinTwigsNorLimbsThatTurnBack) {
  Job job(1, Job::Options{});
  EXPECT_EQ(counts_of(continue_limbs(crown(job, 1, 20, 0.02F), job).limbs, job).limbs, 2U);
  EXPECT_EQ(counts_of(continue_limbs(crown(job, 1, 120, 0.1F), job).limbs, job).limbs, 2U);
  EXPECT_EQ(counts_of(continue_limbs(crown(job, 1, 20, 0.1F), job).limbs, job).limbs, 1U);
}

TEST(LimbContinuation, AreFoundAmongHundredsAtOneJoint) {
  Job job(1, Job::Options{});
  const ContinuedLimbs continued = continue_limbs(crown(job, 400, 40, 0.06F), job);
  EXPECT_GT(continued.limbs.size(), 402U);
  EXPECT_LT(continued.limbs.size(), 414U);
}

TEST(LimbContinuation, MakeClosedBarkOfWhateverATurtleDraws) {
  std::size_t without_surface = 0, joined = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Job job(seed, Job::Options{});
    const Limbs drawn = without_repeats(random_limbs(job, seed), 8, job).limbs;
    const Limbs limbs = continue_limbs(drawn, job).limbs;
    Array<std::int16_t> colors(job);
    bool has_no_surface = false;
    GraftOptions options;
    options.sides = 3 + static_cast<int>(seed % 12);
    options.overlaps = options.points = true;
    options.colors = &colors;
    options.has_no_surface = &has_no_surface;
    GraftCounts counts;
    Mesh mesh = graft(limbs, options, job, &counts);
    without_surface += has_no_surface ? 1U : 0U;
    joined += counts.collars + counts.forks;
    if (has_no_surface) continue;
    ASSERT_EQ(3 * colors.size(), mesh.index.size()) << seed;
    const std::vector<Bark> barks = split_by_color(std::move(mesh), colors.span(), job);
    std::vector<const Mesh*> parts;
    for (const Bark& bark : barks) {
      parts.push_back(&bark.mesh);
    }
    if (parts.empty()) continue;
    const MeshMeasures all = measure(parts);
    EXPECT_EQ(all.open_edges + all.over_used_edges + all.inconsistent_edges, 0U) << seed;
    EXPECT_EQ(all.zero_area + all.flipped_corners + all.duplicate_faces, 0U) << seed;
    EXPECT_EQ(all.not_finite + all.negative_zeros + all.bad_indices + all.not_unit + all.unused, 0U) << seed;
  }
  EXPECT_LT(without_surface, 40U);
  EXPECT_GT(joined, 150U);
}

TEST(GraftColors, ChangeAtTheJointWhereTheLimbChangesThem) {
  Job job(1, Job::Options{});
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root({0, 0, 0});
  joint = maker.grow(joint, {0, 1, 0}, {0.1F, 0.1F});
  maker.color = 3;
  const std::uint32_t middle = joint = maker.grow(joint, {0, 2, 0}, {0.1F, 0.1F});
  maker.color = 1;
  maker.branch(middle, {1, 2.5F, 0}, {0.03F, 0.03F});
  maker.color = 3;
  maker.grow(joint, {0, 3, 0}, {0.1F, 0.1F});
  Array<std::int16_t> colors(job);
  GraftOptions options;
  options.colors = &colors;
  GraftCounts counts;
  Mesh mesh = graft(maker.limbs, options, job, &counts);
  EXPECT_EQ(counts.collars, 1U);
  const std::vector<Bark> barks = split_by_color(std::move(mesh), colors.span(), job);
  ASSERT_EQ(barks.size(), 3U);
  std::vector<const Mesh*> parts;
  for (const Bark& bark : barks) parts.push_back(&bark.mesh);
  EXPECT_EQ(measure(parts).open_edges, 0U);
  EXPECT_EQ(barks[0].color, 0);
  EXPECT_EQ(barks[1].color, 1);
  EXPECT_EQ(barks[2].color, 3);
  EXPECT_NEAR(bounds_of(barks[0].mesh.position.span()).max.y, 1, 1e-5);
  EXPECT_NEAR(bounds_of(barks[2].mesh.position.span()).min.y, 1, 1e-5);
  EXPECT_GT(bounds_of(barks[1].mesh.position.span()).min.x, 0.02F) << "the collar is the twig's";
}

}  // namespace
}  // namespace seedmesh
