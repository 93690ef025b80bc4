/// Scan conversion against edge functions of single samples.
#include "core/render/cover.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.h"

namespace seedmesh::render {
namespace {

constexpr std::int32_t size = 64;

Cover triangle(std::array<std::int32_t, 3> x, std::array<std::int32_t, 3> y) {
  Cover c;
  c.x = x;
  c.y = y;
  const auto area = [&c] {
    return (std::int64_t{c.x[1]} - c.x[0]) * (std::int64_t{c.y[2]} - c.y[0]) -
           (std::int64_t{c.y[1]} - c.y[0]) * (std::int64_t{c.x[2]} - c.x[0]);
  };
  if (area() < 0) {
    std::swap(c.x[1], c.x[2]);
    std::swap(c.y[1], c.y[2]);
  }
  c.area = area();
  return c;
}

/// How often each sample of the image is covered.
void add(Cover c, const Rows& rows, std::vector<int>& times) {
  if (c.area == 0 || !set_box(c, size, rows)) return;
  set_edges(c);
  each_eight(c, size, rows, [&](std::int32_t x, std::int32_t y, Flags inside, Floats across, float down) {
    EXPECT_EQ(x % lanes, 0);
    for (int lane = 0; lane < lanes; ++lane) {
      EXPECT_EQ(across[lane], static_cast<float>(x + lane - c.left));
      if (inside[lane] != 0) ++times[static_cast<std::size_t>(y * size + x + lane)];
    }
    EXPECT_EQ(down, static_cast<float>(y - c.top));
  });
}

/// Whether the centre of a sample is inside, where it is not on an edge; -1: on an edge.
int holds(const Cover& c, std::int64_t column, std::int64_t row) {
  const std::int64_t px = column * fixed_one + fixed_one / 2, py = row * fixed_one + fixed_one / 2;
  bool is_inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::int64_t side =
        (std::int64_t{c.x[j]} - c.x[i]) * (py - c.y[i]) - (std::int64_t{c.y[j]} - c.y[i]) * (px - c.x[i]);
    if (side == 0) return -1;
    is_inside = is_inside && side > 0;
  }
  return is_inside ? 1 : 0;
}

TEST(Cover, ContainsTheSamplesInsideOfRandomTriangles) {
  for (std::uint64_t seed = 0; seed < 3'000; ++seed) {
    const Rng rng = Rng::of_seed(seed);
    // Small ones, slivers, and ones that leave the image by far.
    const double extent = seed % 3 == 0 ? 12 : seed % 3 == 1 ? 80 : 3'000;
    std::array<std::int32_t, 3> x, y;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = static_cast<std::int32_t>((32 + extent * (rng.at(2 * i).unit() - 0.5)) * fixed_one);
      y[i] = static_cast<std::int32_t>((32 + extent * (rng.at(2 * i + 1).unit() - 0.5)) * fixed_one);
    }
    if (seed % 5 == 0) x[2] = x[1] + 3;
    const Cover c = triangle(x, y);
    std::vector<int> times(size * size), in_bands(size * size);
    add(c, {0, size}, times);
    for (std::int32_t begin = 0; begin < size; begin += 13)
      add(c, {begin, std::min(begin + 13, size)}, in_bands);
    EXPECT_EQ(times, in_bands);
    for (std::int32_t row = 0; row < size; ++row) {
      for (std::int32_t column = 0; column < size; ++column) {
        const int expected = c.area == 0 ? 0 : holds(c, column, row);
        const int found = times[static_cast<std::size_t>(row * size + column)];
        ASSERT_TRUE(expected < 0 || found == expected) << seed << ' ' << column << ' ' << row;
      }
    }
  }
}

TEST(Cover, CountsEachSampleOfAFanOnce) {
  // Corners at centres of samples, so that edges pass through them.
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Rng rng = Rng::of_seed(seed);
    const auto centre = [&](std::uint64_t key) {
      return static_cast<std::int32_t>(rng.at(key).unit() * size) * fixed_one + fixed_one / 2;
    };
    const std::int32_t x = centre(0), y = centre(1), far = size * fixed_one;
    std::vector<int> times(size * size);
    const std::array<std::array<std::int32_t, 2>, 4> corners = {{{0, 0}, {far, 0}, {far, far}, {0, far}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % 4];
      add(triangle({x, a[0], b[0]}, {y, a[1], b[1]}), {0, size}, times);
    }
    for (const int each : times) ASSERT_EQ(each, 1) << seed;
  }
}

TEST(Cover, GivesTheBarycentricMeanOfThreeValues) {
  Cover c = triangle({8, 8 + 40 * fixed_one, 8}, {8, 8, 8 + 20 * fixed_one});
  ASSERT_TRUE(set_box(c, size, {0, size}));
  set_edges(c);
  const Plane plane = c.plane(1, 3, 5);
  // Corners at the centres of samples (0, 0), (40, 0) and (0, 20).
  EXPECT_NEAR(plane.of(all_lanes(20.0F), 0)[0], 2, 1e-6);
  EXPECT_NEAR(plane.of(all_lanes(10.0F), 10)[0], 0.25 * 1 + 0.25 * 3 + 0.5 * 5, 1e-6);
}

}  // namespace
}  // namespace seedmesh::render
