#include "core/generators/terrain/subdivide.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/terrain/support.h"

namespace seedmesh::terrain {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::Pointwise;

constexpr std::uint64_t seed = 11;

Field squares(SquareSubdivision plan, int threads = 1, std::uint64_t number = seed) {
  const std::int32_t side = (1 << plan.rounds) + 1;
  return subdivide(plan, World::bounded, {0, 0, side, side}, Rng(number), any_job(threads));
}

SquareSubdivision still(BorderRule border, std::array<double, 4> corners, int rounds) {
  return {.border = border, .rounds = rounds, .amplitude = 0, .corners = corners};
}

TEST(DiamondSquare, FollowsEachEdgeRuleWithoutRandomness) {
  const std::array<double, 4> corners{0, 0, 0, 48};
  const auto heights = [&](BorderRule rule) { return values(squares(still(rule, corners, 1))); };
  EXPECT_THAT(heights(BorderRule::two_neighbours), Pointwise(DoubleEq(), {0, 0, 0, 0, 12, 24, 0, 24, 48}));
  EXPECT_THAT(heights(BorderRule::three), Pointwise(DoubleEq(), {0, 4, 0, 4, 12, 20, 0, 20, 48}));
  EXPECT_THAT(heights(BorderRule::interpolate), Pointwise(DoubleEq(), {0, 3, 0, 3, 12, 21, 0, 21, 48}));
  EXPECT_THAT(heights(BorderRule::wrap), Pointwise(DoubleEq(), {0, 6, 0, 6, 12, 18, 0, 18, 48}));
}

TEST(DiamondSquare, GivesThePublishedFieldOfTwoRounds) {
  const std::vector<double> expected = {0,        3,  4,   13.0 / 3, 0,    3,  5,        7.5, 9,
                                        29.0 / 3, 4,  7.5, 12,       16.5, 20, 13.0 / 3, 9,   16.5,
                                        25,       31, 0,   29.0 / 3, 20,   31, 48};
  EXPECT_THAT(values(squares(still(BorderRule::three, {0, 0, 0, 48}, 2))),
              Pointwise(DoubleNear(1e-5), expected));
}

TEST(DiamondSquare, KeepsAPlaneUnderTwoNeighboursAlone) {
  const Field field = squares(still(BorderRule::two_neighbours, {0, 0, 12, 12}, 5));
  for (int z = 0; z < field.depth; ++z) {
    for (int x = 0; x < field.width; ++x)
      ASSERT_FLOAT_EQ(field.at(x, z), 12.0F * static_cast<float>(z) / 32.0F);
  }
}

TEST(DiamondSquare, RepeatsWithoutASeamWhereItWraps) {
  const Field field = squares({.border = BorderRule::wrap, .rounds = 6, .amplitude = 10, .falloff = 0.6});
  for (int i = 0; i < field.width; ++i) {
    ASSERT_EQ(field.at(i, 0), field.at(i, field.depth - 1));
    ASSERT_EQ(field.at(0, i), field.at(field.width - 1, i));
  }
}

TEST(DiamondSquare, KeepsOldHeightsInAnotherRound) {
  SquareSubdivision plan{.rounds = 5, .amplitude = 10, .falloff = 0.6};
  const Field coarse = squares(plan);
  plan.rounds = 6;
  const Field fine = squares(plan);
  for (int z = 0; z < coarse.depth; ++z) {
    for (int x = 0; x < coarse.width; ++x) ASSERT_EQ(coarse.at(x, z), fine.at(2 * x, 2 * z));
  }
}

TEST(Subdivision, IsTheSameWithAnyNumberOfThreads) {
  for (const SquareRule rule :
       {SquareRule::diamond_square, SquareRule::triangle_midpoint, SquareRule::triangle_random}) {
    const SquareSubdivision plan{.rule = rule, .rounds = 8, .amplitude = 10, .falloff = 0.6};
    EXPECT_EQ(values(squares(plan, 1)), values(squares(plan, 8)));
  }
  const NestedSubdivision nested{.rounds = 8, .amplitude = 10, .falloff = 0.6};
  const Window all{0, 0, 258, 258};
  EXPECT_EQ(values(subdivide_nested(nested, all, Rng(3), any_job(1))),
            values(subdivide_nested(nested, all, Rng(3), any_job(8))));
}

TEST(Subdivision, AgreesBetweenWindowsOfAnInfiniteWorld) {
  for (const SquareRule rule :
       {SquareRule::diamond_square, SquareRule::triangle_midpoint, SquareRule::triangle_random}) {
    const SquareSubdivision plan{.rule = rule, .rounds = 5, .amplitude = 10, .falloff = 0.7};
    const Field large = subdivide(plan, World::unbounded, {-40, -70, 120, 110}, Rng(seed), any_job());
    const Field small = subdivide(plan, World::unbounded, {-3, -9, 30, 25}, Rng(seed), any_job());
    for (int z = 0; z < small.depth; ++z) {
      for (int x = 0; x < small.width; ++x) ASSERT_EQ(small.at(x, z), large.at(x - 3 + 40, z - 9 + 70));
    }
  }
}

TEST(Subdivision, GivesATileTheSameHeightsAsTheWorld) {
  // Under two_neighbours nothing beyond a tile's border reaches into it.
  const SquareSubdivision plan{.rounds = 5, .amplitude = 10, .falloff = 0.7};
  const Field tile = subdivide(plan, World::unbounded, {0, 0, 33, 33}, Rng(seed), any_job());
  EXPECT_EQ(values(tile), values(squares(plan)));
}

TEST(Subdivision, SharesBordersBetweenTilesToTheBit) {
  const NestedSubdivision nested{.rounds = 5, .amplitude = 10, .falloff = 0.7};
  const Field west = subdivide_nested(nested, {-32, 64, 33, 33}, Rng(seed), any_job());
  const Field east = subdivide_nested(nested, {0, 64, 33, 33}, Rng(seed), any_job());
  for (int z = 0; z < 33; ++z) ASSERT_EQ(west.at(32, z), east.at(0, z));
}

TEST(TriangularEdge, IgnoresOldHeightsInItsRandomForm) {
  SquareSubdivision plan{
      .rule = SquareRule::triangle_random, .rounds = 4, .amplitude = 10, .corners = {{0, 0, 0, 0}}};
  const Field low = squares(plan);
  plan.corners = {{5000, 5000, 5000, 5000}};
  const Field high = squares(plan);
  for (int z = 0; z < 17; ++z) {
    for (int x = 0; x < 17; ++x) {
      if (x % 16 == 0 && z % 16 == 0) continue;
      ASSERT_EQ(low.at(x, z), high.at(x, z));
      ASSERT_LE(std::abs(low.at(x, z)), 10.0F);
    }
  }
}

TEST(TriangularEdge, TakesTheMeanOfAnEdgesEndsInItsMidpointForm) {
  const SquareSubdivision plan{
      .rule = SquareRule::triangle_midpoint, .rounds = 1, .amplitude = 0, .corners = {{0, 8, 16, 48}}};
  EXPECT_THAT(values(squares(plan)), Pointwise(DoubleEq(), {0, 4, 8, 8, 24, 28, 16, 32, 48}));
}

TEST(SquareSquare, ConvergesAsPublished) {
  const auto once = [](std::array<double, 9> grid) {
    const NestedSubdivision plan{.rounds = 1, .amplitude = 0, .grid = grid};
    return values(subdivide_nested(plan, {0, 0, 4, 4}, Rng(seed), any_job()));
  };
  EXPECT_THAT(once({0, 0, 0, 0, 16, 0, 0, 0, 0}),
              Pointwise(DoubleEq(), {1, 3, 3, 1, 3, 9, 9, 3, 3, 9, 9, 3, 1, 3, 3, 1}));
  EXPECT_THAT(once({0, 4, 8, 12, 16, 20, 24, 28, 32}),
              Pointwise(DoubleEq(), {4, 6, 8, 10, 10, 12, 14, 16, 16, 18, 20, 22, 22, 24, 26, 28}));
}

TEST(SquareSquare, HasTheSizesOfTheLiterature) {
  for (const auto& [rounds, side] : {std::pair{1, 4}, {2, 6}, {3, 10}, {6, 66}}) {
    const NestedSubdivision plan{.rounds = rounds, .amplitude = 1, .falloff = 0.5};
    const Field field = subdivide_nested(plan, {0, 0, side, side}, Rng(seed), any_job());
    EXPECT_EQ(field.heights.size(), static_cast<std::size_t>(side * side));
    EXPECT_EQ(field.width, side);
  }
}

/// Means over seeds of what a rule gives at an exponent, 513 samples a side.
template <class Measure>
double mean(const std::function<Field(double, std::uint64_t)>& make, double hurst, const Measure& measure) {
  constexpr int seeds = 6;
  double sum = 0;
  for (std::uint64_t number = 1; number <= seeds; ++number) sum += measure(make(std::pow(2, -hurst), number));
  return sum / seeds;
}

Field diamonds(double falloff, std::uint64_t number) {
  return squares({.rounds = 9, .amplitude = 100, .falloff = falloff}, 2, number);
}
Field nested(double falloff, std::uint64_t number) {
  const NestedSubdivision plan{.rounds = 9, .amplitude = 100, .falloff = falloff};
  return subdivide_nested(plan, {0, 0, 514, 514}, Rng(number), any_job(2));
}

TEST(Statistics, OfDiamondSquareFollowTheHurstExponent) {
  for (const auto& [hurst, expected] :
       {std::pair{0.25, 0.261}, {0.5, 0.453}, {0.75, 0.686}, {0.9, 0.795}, {1.0, 0.854}})
    EXPECT_NEAR(mean(diamonds, hurst, measured_hurst), expected, 0.06) << hurst;
}

TEST(Statistics, OfSquareSquareFollowTheHurstExponent) {
  for (const auto& [hurst, expected] :
       {std::pair{0.25, 0.239}, {0.5, 0.439}, {0.75, 0.661}, {0.9, 0.778}, {1.0, 0.872}})
    EXPECT_NEAR(mean(nested, hurst, measured_hurst), expected, 0.06) << hurst;
}

TEST(Statistics, DistinguishCreasesOfDiamondSquareFromSmoothSquareSquare) {
  for (const auto& [hurst, expected] : {std::pair{0.8, 1.43}, {1.0, 2.03}, {1.2, 3.65}}) {
    EXPECT_NEAR(mean(diamonds, hurst, crease_index), expected, 0.2 * expected) << hurst;
    EXPECT_NEAR(mean(nested, hurst, crease_index), 1.0, 0.05) << hurst;
  }
}

}  // namespace
}  // namespace seedmesh::terrain
