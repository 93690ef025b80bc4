#include <gmock/gmock.h>

#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

std::vector<std::uint32_t> indices(const Mesh& mesh) {
  return {mesh.index.wide.begin(), mesh.index.wide.end()};
}

TEST(Wires, ShareVerticesAlongALimb) {
  Job job = job_of();
  SkeletonMaker maker(job);
  const std::uint32_t fork = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {1, 1});
  maker.grow(fork, {0, 2, 0}, {1, 1});
  maker.branch(fork, {1, 2, 0}, {1, 1});
  const auto barks = wires(maker.limbs, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_EQ(barks[0].mesh.topology, Topology::lines);
  EXPECT_THAT(barks[0].mesh.position, SizeIs(4));
  EXPECT_THAT(indices(barks[0].mesh), ElementsAre(0, 1, 1, 2, 1, 3));
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
}

TEST(Wires, MakeAMeshForEachColour) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.color = 7;
  const std::uint32_t joint = maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {1, 1});
  maker.color = 2;
  maker.grow(joint, {0, 2, 0}, {1, 1});
  maker.branch(joint, {1, 2, 0}, {1, 1});
  const auto barks = wires(maker.limbs, job);
  ASSERT_THAT(barks, SizeIs(2));
  EXPECT_EQ(barks[0].color, 2);
  EXPECT_EQ(barks[1].color, 7);
  EXPECT_THAT(barks[0].mesh.position, SizeIs(3));
  EXPECT_THAT(indices(barks[0].mesh), ElementsAre(0, 1, 0, 2));
  EXPECT_THAT(indices(barks[1].mesh), ElementsAre(0, 1));
}

TEST(Wires, MergeJointsThatCoincide) {
  Job job = job_of();
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root({0, 0, 0});
  for (const glm::vec3 to : {glm::vec3{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-0.0F, 0, 0}})
    joint = maker.grow(joint, to, {1, 1});
  const auto barks = wires(maker.limbs, job);
  EXPECT_THAT(barks[0].mesh.position, SizeIs(4));
  EXPECT_THAT(indices(barks[0].mesh), ElementsAre(0, 1, 1, 2, 2, 3, 3, 0));
  EXPECT_THAT(faults(barks[0].mesh), IsEmpty());
}

TEST(Wires, LeaveOutRootsThatNothingGrowsFrom) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.root({5, 5, 5});
  maker.grow(maker.root({0, 0, 0}), {0, 1, 0}, {1, 1});
  maker.root({6, 6, 6});
  EXPECT_THAT(wires(maker.limbs, job)[0].mesh.position, SizeIs(2));
  SkeletonMaker lonely(job);
  lonely.root({0, 0, 0});
  EXPECT_THAT(wires(lonely.limbs, job), IsEmpty());
}

/// A walk of a big model: on a lattice it comes back to its corners again and again.
Limbs long_walk(const Job& job, bool on_lattice, int steps = 200'000) {
  SkeletonMaker maker(job);
  Rng rng(3);
  std::uint32_t joint = maker.root({0, 0, 0});
  Frame frame;
  for (int i = 0; i < steps; ++i) {
    frame = turn(frame,
                 on_lattice ? math::sincos_degrees(90.0 * rng.below(4)) : math::sincos(rng.uniform(-1, 1)));
    joint = maker.grow(joint, maker.limbs.position[joint] + glm::vec3(frame.heading), {1, 1});
  }
  return std::move(maker.limbs);
}

TEST(Wires, MergeOrKeepTheVerticesOfBigModelsAsTheyNeed) {
  Job job = job_of();
  const auto lattice = wires(long_walk(job, true), job);
  EXPECT_LT(lattice[0].mesh.position.size(), 190'000U);
  EXPECT_THAT(faults(lattice[0].mesh), IsEmpty());
  const auto free = wires(long_walk(job, false), job);
  EXPECT_EQ(free[0].mesh.position.size(), 200'001U);
  EXPECT_THAT(faults(free[0].mesh), IsEmpty());
}

TEST(Wires, OfMoreThanAMillionJointsKeepEveryVertex) {
  Job job = job_of();
  constexpr int steps = 1 << 20;
  const Limbs limbs = long_walk(job, true, steps);
  const auto lattice = wires(limbs, job);
  EXPECT_EQ(lattice[0].mesh.position.size(), std::size_t{steps} + 1);
  EXPECT_EQ(lattice[0].mesh.index.size(), 2 * std::size_t{steps});
}

TEST(Wires, OfMovedLimbsAreTheSame) {
  Job job = job_of();
  Limbs limbs = long_walk(job, false);
  const auto copied = wires(limbs, job), moved = wires(std::move(limbs), job);
  EXPECT_EQ(indices(copied[0].mesh), indices(moved[0].mesh));
  EXPECT_TRUE(std::equal(copied[0].mesh.position.begin(), copied[0].mesh.position.end(),
                         moved[0].mesh.position.begin(), moved[0].mesh.position.end()));
}

TEST(Wires, AreTheSameOnAnyNumberOfThreads) {
  Job one = job_of(1), eight = job_of(8);
  const Limbs limbs = long_walk(one, false);
  const auto a = wires(limbs, one), b = wires(limbs, eight);
  EXPECT_EQ(indices(a[0].mesh), indices(b[0].mesh));
  EXPECT_TRUE(std::equal(a[0].mesh.position.begin(), a[0].mesh.position.end(), b[0].mesh.position.begin()));
}

}  // namespace
}  // namespace seedmesh
