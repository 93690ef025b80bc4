#include "core/geom/polygon/delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/polygon/triangulate.h"

namespace seedmesh {
namespace {

using glm::dvec2;

double twice_area(const dvec2& a, const dvec2& b, const dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A star-shaped outline with further points on its edges.
std::vector<dvec2> outline_by(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  const auto corners = 3 + rng.below(12);
  std::vector<dvec2> ring;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const math::SinCos turn = math::sincos(2 * math::pi * i / corners);
    const double radius = rng.uniform(20, 60);
    ring.emplace_back(radius * turn.cos, radius * turn.sin);
  }
  std::vector<dvec2> divided;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const auto pieces = 1 + rng.below(5);
    for (std::uint32_t k = 0; k < pieces; ++k)
      divided.push_back(a + (b - a) * (static_cast<double>(k) / pieces));
  }
  return divided;
}

TEST(Delaunay, FillsTheOutlineOnceAndUsesAllItsEdges) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    std::vector<dvec2> points = outline_by(seed);
    const std::size_t outline = points.size();
    double area = 0;
    for (std::size_t i = 0; i < outline; ++i)
      area += twice_area({0, 0}, points[i], points[(i + 1) % outline]);
    Triangulator triangulator;
    const std::vector<std::uint32_t> sizes = {static_cast<std::uint32_t>(outline)};
    const auto made = triangulator.run(points, sizes, 0);
    std::vector<std::uint32_t> corners(made.begin(), made.end());
    Rng rng = Rng::of_seed(seed).at("inner");
    std::vector<dvec2> inner;
    for (int k = 0; k < 20; ++k) inner.emplace_back(rng.uniform(-40, 40), rng.uniform(-40, 40));
    refine_triangles(points, corners, inner, nullptr);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double filled = 0;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const double twice = twice_area(points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]);
      ASSERT_GT(twice, 0) << "seed " << seed;
      filled += twice;
      for (std::size_t k = 0; k < 3; ++k) ++edges[{corners[i + k], corners[i + (k + 1) % 3]}];
    }
    ASSERT_NEAR(filled / area, 1, 1e-9) << "seed " << seed;
    for (const auto& [edge, count] : edges) ASSERT_EQ(count, 1) << "seed " << seed;
    for (std::uint32_t i = 0; i < outline; ++i)
      ASSERT_EQ((edges.count({i, static_cast<std::uint32_t>((i + 1) % outline)})), 1U) << "seed " << seed;
    ASSERT_EQ(corners.size() / 3, outline - 2 + 2 * (points.size() - outline)) << "seed " << seed;
  }
}

TEST(Delaunay, LeavesNoCornerInTheCircleOfANeighbourWhereAnEdgeMayBeFlipped) {
  // Four points of a rectangle's sides: the short diagonal stays.
  std::vector<dvec2> points = {{0, 0}, {10, -1}, {20, 0}, {10, 1}};
  std::vector<std::uint32_t> corners = {0, 1, 2, 0, 2, 3};
  refine_triangles(points, corners, {}, nullptr);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{corners[i + k], corners[i + (k + 1) % 3]}];
  }
  EXPECT_EQ((edges.count({1, 3}) + edges.count({3, 1})), 2U);
}

}  // namespace
}  // namespace seedmesh
