#include "core/generators/city/border_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double slope = 0.5;  // rise over run of an embankment

/// A border around a circle, with heights that differ too much for the slope at some seeds.
std::vector<BorderPoint> random_border(Rng rng, std::size_t count) {
  std::vector<BorderPoint> points;
  const double rise = rng.uniform(0, 30);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count) - 0.5;
    points.push_back({{100 * t, 80 * (t * t + rng.uniform(0, 0.05))}, rise * rng.uniform(0, 1)});
  }
  return points;
}

double distance(const dvec2& a, const dvec2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(BorderHeights, AreTheExtensionOfMcShaneOfAllPoints) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng = Rng::of_seed(seed);
    const std::vector<BorderPoint> points = random_border(rng.at("border"), 1 + seed * 3);
    const BorderHeights heights(points);
    for (int i = 0; i < 50; ++i) {
      const dvec2 at{rng.uniform(-80, 80), rng.uniform(-40, 60)};
      const double natural = rng.uniform(-10, 40);
      double low = natural, high = natural, highest = 1e300;
      for (const BorderPoint& p : points) {
        low = std::max(low, p.height - slope * distance(p.at, at));
        high = std::min(high, p.height + slope * distance(p.at, at));
        highest = std::min(highest, p.height + slope * distance(p.at, at));
      }
      const double expected = low > natural ? std::min(low, highest) : high;
      EXPECT_NEAR(heights.at(at, natural), expected, 1e-9) << seed;
    }
  }
}

TEST(BorderHeights, LimitEachPointByAllOthers) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<BorderPoint> points = random_border(Rng::of_seed(seed), 1 + seed * 3);
    const BorderHeights heights(points);
    for (const BorderPoint& p : points) {
      double low = p.height, high = p.height;
      for (const BorderPoint& q : points) {
        low = std::max(low, q.height - slope * distance(p.at, q.at));
        high = std::min(high, q.height + slope * distance(p.at, q.at));
      }
      EXPECT_NEAR(heights.limited(p), (low + high) / 2, 1e-9) << seed;
    }
  }
}

TEST(BorderHeights, AreThoseOfAPointAtItsPosition) {
  const BorderHeights heights({{{0, 0}, 3}, {{1, 0}, 9}});
  EXPECT_EQ(heights.at({1, 0}, 0), 9);
  EXPECT_EQ(BorderHeights().at({5, 5}, 2.5), 2.5);
}

}  // namespace
}  // namespace seedmesh::city
