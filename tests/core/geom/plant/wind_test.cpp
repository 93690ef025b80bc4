#include "core/geom/plant/wind.h"

#include <gtest/gtest.h>

#include "core/base/job.h"
#include "core/geom/mesh/manifold_check.h"
#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

/// A trunk of 4 m with a limb at 2 m and a twig at its end.
struct Plant {
  explicit Plant(const Job& job) : maker(job) {
    const auto root = maker.root({0, 0, 0});
    middle = maker.grow(root, {0, 2, 0}, {0.2F, 0.15F});
    top = maker.grow(middle, {0, 4, 0}, {0.15F, 0.1F});
    limb = maker.branch(middle, {2, 3, 0}, {0.08F, 0.04F});
    twig = maker.branch(limb, {2, 4, 0}, {0.02F, 0.01F});
    maker.limbs.order.resize(maker.limbs.size());
    maker.limbs.order[limb] = 1;
    maker.limbs.order[twig] = 2;
    for (const std::uint32_t joint : {root, middle, top}) maker.limbs.order[joint] = 0;
  }
  SkeletonMaker maker;
  std::uint32_t middle, top, limb, twig;
};

TEST(Wind, BendsTheTrunkByTheSquareOfItsHeight) {
  Job job(1, Job::Options{});
  const Plant plant(job);
  const WindField wind(plant.maker.limbs, job);
  EXPECT_FLOAT_EQ(wind.trunk_bend(4), 1);
  EXPECT_FLOAT_EQ(wind.trunk_bend(2), 0.25F);
  EXPECT_EQ(wind.trunk_bend(-1), 0);
  EXPECT_EQ(wind.at(plant.top, {0, 3, 0}).x, 0) << "the trunk has no bend of a branch";
}

TEST(Wind, BendsBranchesFromNothingAtTheTrunkToOneAtTheFarthestTwig) {
  Job job(1, Job::Options{});
  const Plant plant(job);
  const Limbs& limbs = plant.maker.limbs;
  const WindField wind(limbs, job);
  EXPECT_EQ(wind.at(plant.limb, limbs.position[plant.middle]).x, 0);
  const float at_end = wind.at(plant.limb, limbs.position[plant.limb]).x;
  EXPECT_GT(at_end, 0);
  EXPECT_FLOAT_EQ(wind.at(plant.twig, limbs.position[plant.limb]).x, at_end) << "the twig takes over";
  EXPECT_FLOAT_EQ(wind.at(plant.twig, limbs.position[plant.twig]).x, 1);
  EXPECT_EQ(wind.at(plant.twig, {0, 0, 0}).y, wind.at(plant.limb, {0, 0, 0}).y) << "one phase a branch";
}

TEST(Wind, IsTheSameInACoarserLevel) {
  Job job(1, Job::Options{});
  const Plant plant(job);
  const WindField fine(plant.maker.limbs, job);
  Plant thinned(job);
  thinned.maker.limbs.position.resize(4);  // without the twig
  for (auto* each : {&thinned.maker.limbs.radius, &thinned.maker.limbs.base_radius}) each->resize(4);
  thinned.maker.limbs.parent.resize(4);
  const std::vector<std::uint32_t> was{0, 1, 2, 3};
  const WindField coarse(thinned.maker.limbs, was, fine, job);
  const glm::vec3 end = plant.maker.limbs.position[plant.limb];
  EXPECT_FLOAT_EQ(coarse.at(plant.limb, end).x, fine.at(plant.limb, end).x);
}

Mesh square(const Job& job, std::initializer_list<std::uint32_t> index) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0),
                             glm::vec3(1, 1e-7F, 0)})
    mesh.position.push_back(p);
  for (const std::uint32_t i : index) mesh.index.wide.push_back(i);
  return mesh;
}

TEST(ManifoldCheck, FindsEdgesOfMoreThanTwoTrianglesAfterVerticesAreJoined) {
  const Job job(1, Job::Options{});
  EXPECT_FALSE(has_nonmanifold_edges(square(job, {0, 1, 2, 0, 2, 3}), 1e-6F, job));
  EXPECT_TRUE(has_nonmanifold_edges(square(job, {0, 1, 2, 0, 2, 3, 2, 0, 4}), 1e-6F, job))
      << "0-2 three times";
  EXPECT_TRUE(has_nonmanifold_edges(square(job, {0, 1, 2, 4, 2, 3}), 1e-6F, job)) << "1-2 twice the same way";
  EXPECT_FALSE(has_nonmanifold_edges(square(job, {0, 1, 2, 4, 2, 3}), 1e-9F, job))
      << "too far apart to be joined";
}

}  // namespace
}  // namespace seedmesh
