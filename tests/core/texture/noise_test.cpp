#include "core/texture/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/texture/bond.h"
#include "core/texture/cells.h"

namespace seedmesh::texture {
namespace {

constexpr int size = 128;

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

TEST(Noise, IsZeroAtTheCornersOfItsLattice) {
  const Field field = field_of({size, {8, 4}, {1, 1}, 1, Rng::of_seed(3)}, size, job_of());
  for (int y = 0; y < size; y += size / 4) {
    for (int x = 0; x < size; x += size / 8) EXPECT_EQ(field.at(x, y), 0) << x << ' ' << y;
  }
}

// Perlin, "Improving Noise": the second derivative is continuous, so a fine lattice of texels has no jump.
TEST(Noise, HasNoStepBetweenSquaresNorOverTheEdgeOfTheImage) {
  for (const Lattice lattice : {Lattice{3, 5}, Lattice{7, 2}, Lattice{24, 10}}) {
    const Field field = field_of({size, lattice, {1, 1}, 1, Rng::of_seed(9)}, size, job_of());
    // The slope of a noise of amplitude 1 is at most about 4 of its squares.
    const float most = 4.0F * static_cast<float>(std::max(lattice.columns, lattice.rows)) / size;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        ASSERT_LT(std::abs(field.at(x + 1, y) - field.at(x, y)), most) << x << ' ' << y;
        ASSERT_LT(std::abs(field.at(x, y + 1) - field.at(x, y)), most) << x << ' ' << y;
      }
    }
  }
}

TEST(Noise, OfOctavesIsTheSumOfItsLattices) {
  const Rng rng = Rng::of_seed(5);
  const Field all = field_of({size, {5, 3}, {2, 0.5F}, 0.8F, rng}, size, job_of());
  const Field one = field_of({size, {5, 3}, {1, 1}, 0.8F, rng}, size, job_of());
  // The second lattice has its own numbers, so only its range is known: half the amplitude.
  float most = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) most = std::max(most, std::abs(all.at(x, y) - one.at(x, y)));
  }
  EXPECT_GT(most, 0.1F);
  EXPECT_LT(most, 0.4F * 1.4F);
}

TEST(Noise, RidgesHaveTheirCrestsWhereTheNoiseIsZero) {
  const Rng rng = Rng::of_seed(6);
  const Field plain = field_of({size, {6, 6}, {1, 1}, 0.5F, rng}, size, job_of());
  const Field ridge = field_of({size, {6, 6}, {1, 1}, 0.5F, rng, Fold::ridge}, size, job_of());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) ASSERT_NEAR(ridge.at(x, y), 0.5F - std::abs(plain.at(x, y)), 1e-6F);
  }
}

/// The definition, by all points of the image and of its eight copies: half the difference of the squared distances
/// to the two nearest, divided by their distance.
CellRows::Row defined_row(const std::vector<Cells::Point>& points, Lattice lattice, int y,
                          std::array<std::vector<float>, 4>& values) {
  auto& [border, shade, right, down] = values;
  for (std::vector<float>& each : values) each.clear();
  for (int x = 0; x < size; ++x) {
    const float at_x = static_cast<float>(x * lattice.columns) / size,
                at_y = static_cast<float>(y * lattice.rows) / size;
    std::vector<std::pair<float, Cells::Point>> found;
    for (const Cells::Point& each : points) {
      const Cells::Point& p = each;
      found.emplace_back((p.x - at_x) * (p.x - at_x) + (p.y - at_y) * (p.y - at_y), p);
    }
    std::partial_sort(found.begin(), found.begin() + 2, found.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
    const Cells::Point &a = found[0].second, &b = found[1].second;
    border.push_back((found[1].first - found[0].first) / (2 * std::hypot(a.x - b.x, a.y - b.y)));
    shade.push_back(a.shade);
    right.push_back(at_x - a.x);
    down.push_back(at_y - a.y);
  }
  return {border.data(), shade.data(), right.data(), down.data()};
}

TEST(Cells, AreThoseOfTheNearestPoints) {
  const Lattice lattice{9, 5};
  const Cells cells(size, lattice, Rng::of_seed(2));
  const Field still(job_of(), size, 0.0F);
  CellRows rows(cells, still, 1);
  std::array<std::vector<float>, 4> values;
  int differ = 0;
  for (int y = 0; y < size; y += 3) {
    const CellRows::Row found = rows.row(y);
    const CellRows::Row wanted = defined_row(cells.points(), lattice, y, values);
    for (int x = 0; x < size; ++x) {
      // The second nearest point may lie outside of the nine squares.
      const bool is_same = std::abs(found.border[x] - wanted.border[x]) < 1e-4F &&
                           found.shade[x] == wanted.shade[x] &&
                           std::abs(found.right[x] - wanted.right[x]) < 1e-4F &&
                           std::abs(found.down[x] - wanted.down[x]) < 1e-4F;
      differ += is_same ? 0 : 1;
    }
  }
  EXPECT_LT(differ, size * size / 3 / 100);
}

TEST(Bond, ShiftsEveryOtherRowAndMeasuresDistancesInMetres) {
  const Courses courses({4, 2, 0.5F, {2, 1}}, size);
  const Courses::Row even = courses.row(0), odd = courses.row(size / 2);
  EXPECT_EQ(even.row, 0);
  EXPECT_EQ(odd.row, 1);
  EXPECT_EQ(even.column[0], 0);
  EXPECT_EQ(even.column[size - 1], 3);
  EXPECT_EQ(odd.column[size - 1], 0);
  // Texel 16 is the middle of a piece of 0.5 m: a quarter metre to its sides, less half a texel of 1/64 m.
  EXPECT_NEAR(even.to_side[16], 0.25F - 1.0F / 128, 1e-6F);
  EXPECT_NEAR(odd.to_side[16], 1.0F / 128, 1e-6F);
  EXPECT_NEAR(even.to_bed, 0.5F / size, 1e-6F);
}

}  // namespace
}  // namespace seedmesh::texture
