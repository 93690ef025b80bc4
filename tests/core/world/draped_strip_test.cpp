/// Strips on the triangles of tiles, and simplified lines.
#include "core/generators/world/draped_strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

constexpr double lift = 5;

/// The height of the triangles of a grid at a position in it.
double triangles_at(const TerrainGrid& grid, double east, double north) {
  const double u = (east - grid.west) / grid.spacing, v = (north - grid.south) / grid.spacing;
  const int i = std::clamp(static_cast<int>(std::floor(u)), 0, grid.count - 2);
  const int j = std::clamp(static_cast<int>(std::floor(v)), 0, grid.count - 2);
  const double x = u - i, y = v - j, sw = grid.at(i, j).height, ne = grid.at(i + 1, j + 1).height;
  const double corner = x >= y ? grid.at(i + 1, j).height : grid.at(i, j + 1).height;
  // weights of the three corners
  return x >= y ? (1 - x) * sw + (x - y) * corner + y * ne : (1 - y) * sw + (y - x) * corner + x * ne;
}

struct Found {
  double lowest = 1e12, highest = -1e12, out = -1e12, area = 0;
  std::size_t triangles = 0;
};

/// Looks at corners and middles of the triangles of a mesh.
Found found_in(const TileMesh& mesh, const TileFrame& frame, const TerrainGrid& grid, double base) {
  Found found;
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    std::array<glm::dvec3, 3> p;
    for (std::size_t n = 0; n < 3; ++n) {
      const TileVertex& vertex = mesh.vertices[mesh.indices[k + n]];
      p[n] = {frame.middle_east + vertex.x * frame.step, frame.middle_north - vertex.z * frame.step,
              base + vertex.y * frame.step};
    }
    for (const glm::dvec3& at : {p[0], p[1], p[2], (p[0] + p[1] + p[2]) / 3.0}) {
      const double above = at.z - triangles_at(grid, at.x, at.y);
      found.lowest = std::min(found.lowest, above);
      found.highest = std::max(found.highest, above);
      found.out =
          std::max({found.out, std::abs(at.x - frame.middle_east), std::abs(at.y - frame.middle_north)});
    }
    found.area += ((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)) / 2;
    ++found.triangles;
  }
  return found;
}

TEST(DrapedStrip, LiesOnTheTerrainOfItsTileAndKeepsItsArea) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::size_t triangles = 0, crossings = 0;
  for (int n = 0; n < 40; ++n) {
    Rng rng = Rng::of_seed(static_cast<std::uint64_t>(n));
    const int level = world.levels - 8;
    const auto along = [&] { return static_cast<std::int64_t>(rng.unit() * std::ldexp(1, level)); };
    const TileFrame frame = frame_of(world, {level, along(), along()});
    const TerrainGrid grid = sample_grid(world, frame, frame.cells, 1, job);
    const double base = std::floor(grid.at(16, 16).height / frame.step) * frame.step, width = 8;
    const auto inside = [&] { return (0.1 + 0.8 * rng.unit()) * frame.side; };
    const glm::dvec3 a(frame.west + inside(), frame.south + inside(), 0),
        b(frame.west + inside(), frame.south + inside(), 0);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const glm::dvec3 side = glm::dvec3(a.y - b.y, b.x - a.x, 0) * (width / 2 / length);
    FlatMesh builder(frame, base, {0, 0, 0, 255});
    add_draped_strip(builder, grid, {a + side, a - side}, {b + side, b - side}, lift);
    const Found found = found_in(builder.take(), frame, grid, base);
    EXPECT_GT(found.lowest, 0.4 * lift - 1.5) << "the width of the strip and rounding";
    EXPECT_LT(found.highest, 2 * lift + 1.5);
    EXPECT_NEAR(found.area, width * length, 0.1 * width * length + 2 * frame.step * length);
    triangles += found.triangles;
    crossings += static_cast<std::size_t>(
        (std::abs(b.x - a.x) + std::abs(b.y - a.y) + std::abs(b.x - a.x - b.y + a.y)) / frame.spacing);
  }
  EXPECT_LT(triangles, 2 * crossings) << "some crossings need no vertices";
}

/// Two tiles that share a border have the same vertices of a strip there.
TEST(DrapedStrip, MeetsThatOfTheNextTile) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  const int level = world.levels - 8;
  for (std::int64_t n = 0; n < 20; ++n) {
    Rng rng = Rng::of_seed(static_cast<std::uint64_t>(n));
    const std::int64_t x = 3 * n % 11, y = 7 * n % 13;
    std::array<std::vector<std::array<double, 2>>, 2> at_border;
    const TileFrame west = frame_of(world, {level, x, y});
    const double border = west.west + west.side;
    const glm::dvec3 a(west.west + rng.unit() * west.side, west.south + rng.uniform(0.2, 0.8) * west.side, 0);
    const glm::dvec3 b(border + rng.unit() * west.side, west.south + rng.uniform(0.2, 0.8) * west.side, 0);
    const glm::dvec3 side = glm::dvec3(a.y - b.y, b.x - a.x, 0) * (20 / std::hypot(b.x - a.x, b.y - a.y));
    for (std::int64_t k = 0; k < 2; ++k) {
      const TileFrame frame = frame_of(world, {level, x + k, y});
      const TerrainGrid grid = sample_grid(world, frame, frame.cells, 1, job);
      FlatMesh builder(frame, 0, {0, 0, 0, 255});
      add_draped_strip(builder, grid, {a + side, a - side}, {b + side, b - side}, lift);
      for (const TileVertex& vertex : builder.take().vertices) {
        if (frame.middle_east + vertex.x * frame.step == border)
          at_border[static_cast<std::size_t>(k)].push_back({vertex.y * frame.step, vertex.z * frame.step});
      }
      ASSERT_GE(at_border[static_cast<std::size_t>(k)].size(), 2U);
    }
    for (const std::size_t axis : {0U, 1U}) {
      const auto range = [axis](const std::vector<std::array<double, 2>>& points) {
        const auto [low, high] = std::minmax_element(
            points.begin(), points.end(), [axis](const auto& p, const auto& q) { return p[axis] < q[axis]; });
        return std::array<double, 2>{(*low)[axis], (*high)[axis]};
      };
      EXPECT_NEAR(range(at_border[0])[0], range(at_border[1])[0], axis == 0 ? lift : west.step);
      EXPECT_NEAR(range(at_border[0])[1], range(at_border[1])[1], axis == 0 ? lift : west.step);
    }
  }
}

/// The circle of radius 1,000: chords that leave it by at most 10 span 16.2 degrees, so 23 or more remain.
TEST(SimplifiedLine, StaysWithinItsTolerance) {
  std::vector<RiverPoint> circle;
  for (int k = 0; k <= 720; ++k) {
    RiverPoint p;
    p.east = 1000 * std::cos(k * M_PI / 360);
    p.north = 1000 * std::sin(k * M_PI / 360);
    circle.push_back(p);
  }
  const std::vector<RiverPoint> kept = simplified_line(circle, 10);
  EXPECT_GE(kept.size(), 23U);
  EXPECT_LE(kept.size(), 46U);
  EXPECT_EQ(kept.front().east, circle.front().east);
  EXPECT_EQ(kept.back().north, circle.back().north);
  for (std::size_t k = 1; k < kept.size(); ++k) {
    const double x = (kept[k].east + kept[k - 1].east) / 2, y = (kept[k].north + kept[k - 1].north) / 2;
    EXPECT_GE(std::hypot(x, y), 990 - 0.1);
  }
}

}  // namespace
}  // namespace seedmesh::world
