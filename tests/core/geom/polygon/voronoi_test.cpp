#include "core/geom/polygon/voronoi.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/base/rng.h"
#include "core/geom/polygon/plan.h"

namespace seedmesh {
namespace {

using glm::dvec2;

double area_of(const std::vector<dvec2>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

TEST(Voronoi, DividesTheBoxOfASquareLatticeIntoSquares) {
  std::vector<dvec2> points;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) points.emplace_back(i + 0.5, k + 0.5);
  }
  const Job job(0, Job::Options{});
  const auto cells = voronoi_cells(points, {0, 0}, {4, 4}, job);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_NEAR(area_of(cells[i]), 1, 1e-12);
    EXPECT_NEAR(glm::length(centroid_of(cells[i]) - points[i]), 0, 1e-12);
  }
}

TEST(Voronoi, PutsEachCornerAtEqualDistancesFromItsNearestPoints) {
  Rng rng = Rng::of_seed(5);
  const Job job(0, Job::Options{});
  for (int round = 0; round < 40; ++round) {
    std::vector<dvec2> points;
    for (int i = 0; i < 50; ++i) points.emplace_back(rng.uniform(-9, 9), rng.uniform(-4, 4));
    const auto cells = voronoi_cells(points, {-10, -5}, {10, 5}, job);
    double sum = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_GT(area_of(cells[i]), 0);
      sum += area_of(cells[i]);
      for (const dvec2& corner : cells[i]) {
        double nearest = 1e300;
        for (const dvec2& p : points) nearest = std::min(nearest, glm::length(p - corner));
        ASSERT_NEAR(glm::length(points[i] - corner), nearest, 1e-9);
      }
    }
    EXPECT_NEAR(sum, 200, 1e-9);
  }
}

}  // namespace
}  // namespace seedmesh
