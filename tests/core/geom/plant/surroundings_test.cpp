#include "core/geom/plant/surroundings.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.h"
#include "core/geom/plant/turtle.h"

namespace seedmesh {
namespace {

TEST(Surroundings, ForbidWhereTheSignedDistanceIsNegative) {
  Job job(1, Job::Options{});
  const Solid box{SolidShape::box, {0, 0, 0}, {2, 2, 2}, nullptr};
  const Solid sphere{SolidShape::sphere, {1.5, 0, 0}, {2, 2, 2}, nullptr};
  const Solid cone{SolidShape::cone, {0, 0, 0}, {1, 1, 1}, nullptr};
  for (const auto& guides : {std::vector<Solid>{}, {box}, {box, sphere}}) {
    for (const auto& obstacles : {std::vector<Solid>{}, {cone}, {cone, sphere}}) {
      Surroundings::Options options;
      options.guides = guides;
      options.obstacles = obstacles;
      const Surroundings all(options, job);
      Rng rng(7);
      int forbidden = 0;
      for (int i = 0; i < 400; ++i) {
        const glm::dvec3 p{rng.uniform(-2, 3), rng.uniform(-1, 3), rng.uniform(-2, 2)};
        EXPECT_EQ(all.forbids(p), all.signed_distance_at(p) < 0);
        forbidden += all.forbids(p) ? 1 : 0;
      }
      EXPECT_EQ(forbidden > 0, !guides.empty() || !obstacles.empty());
      EXPECT_LT(forbidden, 400);
    }
  }
}

/// A skeleton of limbs that start at the middle and leave the unit box in all directions.
Skeleton rays(Job& job) {
  Skeleton skeleton(job);
  Turtle turtle(&skeleton, 0.01, job);
  Rng rng(3);
  for (int i = 0; i < 40; ++i) {
    turtle.push();
    turtle.set_heading({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)});
    for (int k = 0; k < 8; ++k) turtle.draw(0.17, 0);
    turtle.pop();
  }
  return skeleton;
}

TEST(Prune, GivesTheSameLimbsWithKnownSharesAndWithoutThem) {
  Job job(1, Job::Options{});
  Surroundings::Options options;
  options.guides = {Solid{SolidShape::box, {0, -0.5, 0}, {1, 1, 1}, nullptr}};
  const Surroundings box(options, job);
  for (const Membership membership : {Membership::centre, Membership::whole, Membership::clipped}) {
    ShareCache known(job);
    Skeleton expected = rays(job);
    const std::size_t all = expected.limbs.size();
    prune(expected, box, membership, nullptr, job);
    EXPECT_LT(expected.limbs.size(), all);
    EXPECT_GT(expected.limbs.size(), all / 4);
    // The second time, all shares are known.
    for (int time = 0; time < 2; ++time) {
      Skeleton skeleton = rays(job);
      prune(skeleton, box, membership, &known, job);
      ASSERT_EQ(skeleton.limbs.size(), expected.limbs.size());
      for (std::size_t i = 0; i < expected.limbs.size(); ++i) {
        EXPECT_EQ(skeleton.limbs.position[i], expected.limbs.position[i]);
        EXPECT_EQ(skeleton.limbs.parent[i], expected.limbs.parent[i]);
      }
    }
  }
}

TEST(ShareCache, FindsEachOfManyInternodes) {
  Job job(1, Job::Options{});
  ShareCache known(job);
  EXPECT_EQ(known.find({0, 0, 0}, {0, 1, 0}), nullptr);
  const auto share_of = [](int i) { return i % 101 / 100.0; };
  const auto to = [](int i) { return glm::vec3(static_cast<float>(i), 1, 0); };
  for (int i = 0; i < 5000; ++i) known.keep({0, 0, 0}, to(i), share_of(i));
  for (int i = 0; i < 5000; ++i) {
    const double* found = known.find({0, 0, 0}, to(i));
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(*found, share_of(i));
  }
  EXPECT_EQ(known.find({0, 0, 0}, {0.5F, 1, 0}), nullptr);
}

TEST(Surroundings, QueriesSeeTheInternodesThatWereSetLast) {
  Job job(1, Job::Options{});
  Surroundings around(Surroundings::Options{}, job);
  GrowthTip tip;
  tip.heading = {1, 0, 0};
  // A pillar of four cells, each of which shades the cells below it by 0.2 / 1.6^layers.
  std::vector<GrownInternode> pillar;
  double shade = 0, amount = ShadowOptions{}.shade;
  for (std::uint32_t i = 0; i < 4; ++i) {
    GrownInternode internode;
    internode.from = {0.75, -0.25 + 0.5 * i, 0.25};
    internode.to = {0.75, 0.25 + 0.5 * i, 0.25};
    internode.radius = 0.1;
    internode.system = 1;
    internode.joint = i + 1;
    internode.parent = i;
    pillar.push_back(internode);
    amount /= ShadowOptions{}.falloff;
    shade += amount;
  }
  tip.position = {0, 0.25, 0.25};
  const glm::dvec3 below{0.75, -0.25, 0.25};
  for (int time = 0; time < 2; ++time) {
    around.set_internodes({});
    EXPECT_TRUE(around.is_free(tip, 1));
    EXPECT_EQ(around.light_at(below), 1);
    around.set_internodes(pillar);
    EXPECT_FALSE(around.is_free(tip, 1));
    EXPECT_TRUE(around.is_free(tip, 0.5));
    EXPECT_NEAR(around.light_at(below), 1 - (shade - ShadowOptions{}.shade), 1e-12);
  }
}

}  // namespace
}  // namespace seedmesh
