#include "core/geom/plant/shadow_grid.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

const ShadowOptions options{0.5, 0.2, 2, 6};

TEST(ShadowGrid, CastsAPyramidBelowACell) {
  const Job job(1, Job::Options{});
  ShadowGrid grid(options, job);
  grid.add({0.25, 10.25, 0.25});
  for (int layer = 0; layer <= 7; ++layer) {
    const double y = 10.25 - 0.5 * layer;
    const double expected = layer > 6 ? 0 : 0.2 / (1 << layer);
    EXPECT_NEAR(grid.shade_at({0.25, y, 0.25}), expected, 1e-4);
    EXPECT_NEAR(grid.shade_at({0.25 + 0.5 * layer, y, 0.25 - 0.5 * layer}), expected, 1e-4);
    EXPECT_EQ(grid.shade_at({0.25 + 0.5 * (layer + 1), y, 0.25}), 0);
  }
  EXPECT_EQ(grid.shade_at({0.25, 10.75, 0.25}), 0);
}

TEST(ShadowGrid, IsExactlyEmptyAgainWhenEveryShadowIsRemoved) {
  const Job job(1, Job::Options{});
  ShadowGrid grid(options, job);
  Rng rng(7);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(rng.uniform(-20, 20), rng.uniform(0, 30), rng.uniform(-20, 20));
    grid.add(points.back());
  }
  for (const glm::dvec3& point : points) grid.remove(point);
  for (const glm::dvec3& point : points) EXPECT_EQ(grid.shade_at(point), 0);
}

TEST(ShadowGrid, HasTheLightOfOpenLSystems) {
  Job job(1, Job::Options{});
  ShadowGrid grid(options, job);
  Surroundings::Options around;
  around.shadow = options;
  Surroundings surroundings(around, job);
  // One internode in each of several cells.
  std::vector<GrownInternode> grown;
  for (int i = 0; i < 5; ++i) {
    GrownInternode internode;
    internode.from = {0.25, 8.25, 0.25 + 0.5 * i};
    internode.to = {0.25, 8.75, 0.25 + 0.5 * i};
    grown.push_back(internode);
    grid.add(internode.to);
  }
  surroundings.set_internodes(grown);
  for (const glm::dvec3 point : {glm::dvec3{0.25, 8.25, 0.75}, {0.25, 7.25, 1.25}, {1.25, 6.75, 0.25}}) {
    const double shade = grid.shade_at(point);
    EXPECT_NEAR(surroundings.light_at(point), std::clamp(1 - (shade - options.shade), 0.0, 1.0), 1e-4);
  }
}

}  // namespace
}  // namespace seedmesh
