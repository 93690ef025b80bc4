#include "core/geom/lod/foliage_levels.h"

#include <gmock/gmock.h>

#include <set>

#include "core/base/rng.h"
#include "core/geom/plant/leaf_mesh.h"
#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

Job job_of(int threads = 1) {
  Job::Options options;
  options.threads = threads;
  return Job(1, options);
}

/// Leaves at random in a ball of radius 1.
Organs ball_of_leaves(const Job& job, int count) {
  Organs organs(job);
  Rng rng(5);
  while (static_cast<int>(organs.organ.size()) < count) {
    const auto coordinate = [&] { return static_cast<float>(rng.uniform(-1, 1)); };
    Organ organ;
    organ.position = {coordinate(), coordinate(), coordinate()};
    if (glm::dot(organ.position, organ.position) > 1) continue;
    organ.frame = glm::normalize(glm::quat(coordinate(), coordinate(), coordinate(), coordinate()));
    organ.scale = glm::vec3(0.12F);
    organ.key = rng.next();
    organs.organ.push_back(organ);
  }
  return organs;
}

std::set<std::uint64_t> keys(const Organs& organs) {
  std::set<std::uint64_t> all;
  for (const Organ& organ : organs.organ) all.insert(organ.key);
  return all;
}

struct Ball {
  explicit Ball(Job& given, int count = 4000)
      : job(given),
        organs(ball_of_leaves(job, count)),
        leaf(leaf_mesh({.build = LeafBuild::card}, job)),
        levels(FoliageLevels::Plant{organs, std::span(&leaf, 1), Limbs(job), 0.8F}, job) {}
  Job& job;
  Organs organs;
  Mesh leaf;
  FoliageLevels levels;
};

TEST(FoliageLevels, KeepTheRequestedShareOfPositions) {
  Job job = job_of();
  Ball ball(job);
  std::set<std::uint64_t> finer = keys(ball.organs);
  for (const double share : {0.9, 0.7, 0.5, 0.4}) {
    const Organs kept = ball.levels.keep(ball.organs, share, job);
    EXPECT_NEAR(static_cast<double>(kept.organ.size()), share * 4000, 2);
    const std::set<std::uint64_t> own = keys(kept);
    EXPECT_TRUE(std::includes(finer.begin(), finer.end(), own.begin(), own.end()));
    finer = own;
  }
}

TEST(FoliageLevels, CountTheLeavesThatTheOutlineNeeds) {
  Job job = job_of();
  const Ball dense(job, 6000), sparse(job, 600);
  double before = 1;
  for (const double loss : {0.0, 0.01, 0.03, 0.1}) {
    const double share = dense.levels.share_for(loss);
    EXPECT_LE(share, before);
    EXPECT_GE(sparse.levels.share_for(loss), share) << "fewer leaves hide each other";
    before = share;
  }
  EXPECT_GE(before, 0.2);
  EXPECT_GT(sparse.levels.share_for(0.01), 0.9);
}

TEST(FoliageLevels, TakeLeavesInsideTheCrownFirst) {
  Job job = job_of();
  Ball ball(job);
  const Organs kept = ball.levels.keep(ball.organs, 0.5, job);
  const auto outside = [](const Organs& organs) {
    std::size_t count = 0;
    for (const Organ& organ : organs.organ) count += glm::dot(organ.position, organ.position) > 0.9F ? 1 : 0;
    return static_cast<double>(count);
  };
  EXPECT_GT(outside(kept), 0.75 * outside(ball.organs));
}

TEST(FoliageLevels, EnlargeWhatIsLeftInsideRatherThanAtTheOutline) {
  Job job = job_of();
  Ball ball(job, 1500);
  const Organs kept = ball.levels.keep(ball.organs, 0.4, job);
  double inner = 0, outer = 0;
  std::size_t inside = 0, outside = 0;
  for (const Organ& organ : kept.organ) {
    EXPECT_GE(organ.scale.x, 0.12F);
    EXPECT_LE(organ.scale.x, 0.12F * 2.5F);
    const bool is_out = glm::dot(organ.position, organ.position) > 0.8F;
    (is_out ? outer : inner) += static_cast<double>(organ.scale.x);
    ++(is_out ? outside : inside);
  }
  EXPECT_GT(inner / static_cast<double>(inside), 1.03 * outer / static_cast<double>(outside));
}

TEST(FoliageLevels, SeeAThickLimbHideLeavesAndLeavesHideALimb) {
  Job job = job_of();
  Ball ball(job);
  SkeletonMaker maker(job);
  const std::uint32_t inside = maker.grow(maker.root({0, -0.2F, 0}), {0, 0.2F, 0}, {0.02F, 0.02F});
  const std::uint32_t outside = maker.grow(inside, {0, 3, 0}, {0.02F, 0.02F});
  const Array<float> shown = ball.levels.shown(maker.limbs, job);
  EXPECT_LT(shown[inside], 0.1F);
  EXPECT_GT(shown[outside], 0.2F);
}

TEST(FoliageLevels, AreTheSameWithManyThreads) {
  Job one = job_of(), many = job_of(8);
  Ball a(one, 500), b(many, 500);
  const Organs first = a.levels.keep(a.organs, 0.5, one), second = b.levels.keep(b.organs, 0.5, many);
  ASSERT_EQ(first.organ.size(), second.organ.size());
  for (std::size_t i = 0; i < first.organ.size(); ++i) EXPECT_EQ(first.organ[i].scale, second.organ[i].scale);
}

}  // namespace
}  // namespace seedmesh
