#include "core/geom/graft.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/quick_math.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

/// A trunk with limbs in a spiral, each with twigs, of which some leave so flat that no collar fits.
Limbs spiral(const Job& job, double steepest) {
  SkeletonMaker maker(job);
  std::uint32_t trunk = maker.root({0, 0, 0});
  Rng rng(8);
  for (int i = 1; i <= 30; ++i) {
    const float height = 0.25F * static_cast<float>(i), radius = 0.2F * (1 - height / 9);
    trunk = maker.grow(trunk, {0, height, 0}, {radius + 0.006F, radius});
    const math::SinCos around = math::quick_sincos_degrees(137.5 * i);
    const math::SinCos lean = math::quick_sincos_degrees(rng.uniform(8, steepest));
    const glm::dvec3 along{around.cos * lean.sin, lean.cos, around.sin * lean.sin};
    const float thick = radius * static_cast<float>(rng.uniform(0.2, 0.9));
    glm::vec3 at = maker.limbs.position[trunk] + glm::vec3(along * 0.9);
    auto limb = maker.branch(trunk, at, {thick, 0.6F * thick});
    for (int k = 0; k < 4; ++k) {
      at += glm::vec3(along * 0.3) + glm::vec3(0, 0.05F, 0);
      limb = maker.grow(limb, at, {0.6F * thick, 0.5F * thick});
      maker.branch(limb, at + glm::vec3(0.2F * static_cast<float>(k - 1), 0.3F, 0.1F),
                   {0.2F * thick, 0.1F * thick});
    }
  }
  return std::move(maker.limbs);
}

TEST(Graft, MakesOneClosedSurfaceOfLimbsThatHaveRoom) {
  Job job(1, Job::Options{});
  GraftCounts counts;
  const Mesh mesh = graft(spiral(job, 80), {}, job, &counts);
  EXPECT_TRUE(faults(mesh).empty());
  EXPECT_EQ(measure({&mesh}).open_edges, 0U);
  EXPECT_GT(counts.collars + counts.forks, 60U);
  EXPECT_GT(counts.closed, 0U) << "some leave too flat";
  EXPECT_EQ(counts.limbs, 1 + counts.collars + counts.forks + counts.closed);
}

TEST(Graft, StaysSoundWhateverTheLimbsAre) {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Job job(seed, Job::Options{});
    GraftOptions options;
    options.overlaps = true;
    options.wrap = seed % 2;
    Array<std::uint32_t> joints(job);
    options.joints = seed % 3 ? &joints : nullptr;
    const Limbs limbs = random_limbs(job, seed);
    try {
      const Mesh mesh = graft(limbs, options, job);
      for (const std::string& fault : faults(mesh)) {
        // Limbs that are drawn twice begin with the same vertex.
        const bool is_drawn_twice = fault.find("duplicate vertices") != std::string::npos;
        EXPECT_TRUE(is_drawn_twice) << "seed " << seed << ": " << fault;
      }
      if (options.joints) {
        EXPECT_EQ(joints.size(), mesh.position.size());
        for (const std::uint32_t joint : joints) EXPECT_LT(joint, limbs.size());
      }
      made += mesh.position.empty() ? 0 : 1;
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.code(), Code::limit);
    }
  }
  EXPECT_GT(made, 80);
}

TEST(Graft, WrapsUAWholeNumberOfTimesRoundALimb) {
  Job job(1, Job::Options{});
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 5, 0}, {0.5F, 0.3F});
  GraftOptions options;
  options.wrap = true;
  const Mesh mesh = graft(maker.limbs, options, job);
  float low = 0, high = 0;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    if (mesh.normal[i].y < -0.5F) continue;  // the floor
    low = std::min(low, mesh.uv[0][i].x);
    high = std::max(high, mesh.uv[0][i].x);
  }
  EXPECT_NEAR(high - low, 3, 1e-4) << "once a metre of 3.14";
}

}  // namespace
}  // namespace seedmesh
