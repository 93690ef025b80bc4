#include "core/texture/pair_palette.h"

#include <gtest/gtest.h>

#include <set>

namespace seedmesh::texture {
namespace {

using Counts = std::array<std::uint32_t, pair_count>;

constexpr std::uint32_t number_of(std::uint32_t first, std::uint32_t second) {
  return first + pair_levels * second;
}

/// The sum of squared distances between bytes before and after, recomputed pair by pair.
double error_of(const Counts& counts, const PairPalette& palette) {
  double sum = 0;
  for (std::uint32_t i = 0; i < pair_count; ++i) {
    const glm::u8vec2 color = counts[i] > 0 ? palette.colors.at(palette.of[i]) : glm::u8vec2(0);
    const double a = static_cast<double>(byte_of_level(i % pair_levels)) - color.x;
    const double b = static_cast<double>(byte_of_level(i / pair_levels)) - color.y;
    sum += counts[i] * (a * a + b * b);
  }
  return sum;
}

TEST(PairPalette, IsExactForUpTo256Pairs) {
  Counts counts{};
  for (std::uint32_t i = 0; i < 256; ++i) counts[(i * 61) % pair_count] = i + 1;
  const PairPalette palette = pair_palette(counts);
  EXPECT_EQ(palette.colors.size(), 256U);
  EXPECT_EQ(error_of(counts, palette), 0);
}

TEST(PairPalette, OfOnePairHasOneColour) {
  Counts counts{};
  counts[number_of(32, 63)] = 7;
  const PairPalette palette = pair_palette(counts);
  ASSERT_EQ(palette.colors.size(), 1U);
  EXPECT_EQ(palette.colors[0], glm::u8vec2(128, 255));
}

TEST(PairPalette, OfEqualCountsIsAsGoodAsAGrid) {
  Counts counts{};
  counts.fill(10);
  const PairPalette palette = pair_palette(counts);
  EXPECT_LE(palette.colors.size(), 256U);
  EXPECT_GT(palette.colors.size(), 250U);
  // Squares of 4 by 4 levels of 4 bytes: the variance of {-6, -2, 2, 6} in both channels.
  EXPECT_LE(error_of(counts, palette) / (10.0 * pair_count), 2 * 20 * 1.05);
}

TEST(PairPalette, KeepsFrequentPairsExact) {
  Counts counts{};
  counts.fill(1);
  counts[number_of(32, 32)] = counts[number_of(33, 32)] = counts[number_of(10, 50)] = 100'000;
  const PairPalette palette = pair_palette(counts);
  std::set<std::uint8_t> colors;
  for (const std::uint32_t pair : {number_of(32, 32), number_of(33, 32), number_of(10, 50)}) {
    const glm::u8vec2 color = palette.colors.at(palette.of[pair]);
    EXPECT_EQ(color.x, byte_of_level(pair % pair_levels));
    EXPECT_EQ(color.y, byte_of_level(pair / pair_levels));
    colors.insert(palette.of[pair]);
  }
  EXPECT_EQ(colors.size(), 3U);
}

TEST(PairCounts, AddUpToTheNumberOfPairs) {
  PairCounts counts;
  const std::vector<std::uint32_t> row{1, 1, 2, 4095, 1};
  counts.add(row);
  counts.add(row);
  const Counts sums = counts.sums();
  EXPECT_EQ(sums[1], 6U);
  EXPECT_EQ(sums[2], 2U);
  EXPECT_EQ(sums[4095], 2U);
  EXPECT_EQ(sums[0], 0U);
}

}  // namespace
}  // namespace seedmesh::texture
