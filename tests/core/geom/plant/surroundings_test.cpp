#include "core/geom/plant/surroundings.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.h"

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

}  // namespace
}  // namespace seedmesh
