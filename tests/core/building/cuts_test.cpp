#include "core/generators/building/cuts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.h"

namespace seedmesh::building {
namespace {

Cell absolute(double size) { return {.size = size, .measure = Measure::absolute}; }
Cell relative(double share) { return {.size = share, .measure = Measure::relative}; }
Cell floating(double size) { return {.size = size, .measure = Measure::floating}; }

std::vector<double> sizes(std::vector<Cell> cells, double length, Rounding rounding = Rounding::nearest) {
  std::vector<Cut> cuts;
  double wanted = 0;
  EXPECT_TRUE(cut(cells, static_cast<std::uint32_t>(cells.size()), length, {rounding, 1e6}, cuts, wanted));
  std::vector<double> out;
  for (const Cut& each : cuts) out.push_back(each.size);
  return out;
}

/// One group of `inner` and nothing else.
std::vector<Cell> repeated(const std::vector<Cell>& inner) {
  std::vector<Cell> cells{{.is_group = true, .first = 1, .count = static_cast<std::uint32_t>(inner.size())}};
  cells.insert(cells.end(), inner.begin(), inner.end());
  return cells;
}

std::vector<double> repeat(const std::vector<Cell>& inner, double length,
                           Rounding rounding = Rounding::nearest) {
  const std::vector<Cell> cells = repeated(inner);
  std::vector<Cut> cuts;
  double wanted = 0;
  EXPECT_TRUE(cut(cells, 1, length, {rounding, 1e6}, cuts, wanted));
  std::vector<double> out;
  for (const Cut& each : cuts) out.push_back(each.size);
  return out;
}

using List = std::vector<double>;

TEST(Cuts, LeaveAGapWhereAbsoluteSizesFallShort) { EXPECT_EQ(sizes({absolute(3)}, 5), List({3})); }

TEST(Cuts, ClipThePieceAtTheEndAndOmitLaterOnes) {
  EXPECT_EQ(sizes({absolute(2), absolute(1), absolute(1), absolute(2), absolute(1)}, 5), List({2, 1, 1, 1}));
  EXPECT_EQ(sizes({relative(0.5), relative(0.6), absolute(3)}, 10), List({5, 5}));
}

TEST(Cuts, ShareTheRestAmongFloatingSizes) {
  EXPECT_EQ(sizes({absolute(2), floating(1), floating(3)}, 10), List({2, 2, 6}));
  EXPECT_EQ(sizes({absolute(3), floating(1), absolute(2)}, 5), List({3, 2}));
}

TEST(Cuts, RepeatFloatingSizesSoThatTheyStretchLeast) {
  EXPECT_EQ(repeat({floating(2.1)}, 10), List({2, 2, 2, 2, 2}));
  EXPECT_EQ(repeat({floating(3)}, 7).size(), 2U);
  EXPECT_EQ(repeat({floating(3)}, 7, Rounding::ceil).size(), 3U);
}

TEST(Cuts, CutTheLastCycleOffWhereNothingFloats) {
  EXPECT_EQ(repeat({absolute(2), absolute(1)}, 10), List({2, 1, 2, 1, 2, 1, 1}));
}

TEST(Cuts, RejectTooManyPiecesWithoutMakingThem) {
  const std::vector<Cell> cells = repeated({absolute(1e-9)});
  std::vector<Cut> cuts;
  double wanted = 0;
  EXPECT_FALSE(cut(cells, 1, 1e9, {Rounding::nearest, 1e6}, cuts, wanted));
  EXPECT_GT(wanted, 1e17);
  EXPECT_TRUE(cuts.empty());
}

TEST(Cuts, CountCopiesOfARepeatDespiteRounding) {
  EXPECT_EQ(copies_of(0.9, 0.3, Rounding::ceil), 3);
  EXPECT_EQ(copies_of(7, 3, Rounding::ceil), 3);
  EXPECT_EQ(copies_of(7, 3, Rounding::nearest), 2);
  EXPECT_EQ(copies_of(0.1, 3, Rounding::nearest), 1);
}

/// Random splits, nested repeats among them: pieces follow each other without gap or overlap, lie inside, and
/// fill the whole where something floats and there is room.
TEST(Cuts, NeverLeaveAGapOrOverlap) {
  Rng rng(17);
  const auto random_cell = [&] {
    Cell cell;
    cell.measure = static_cast<Measure>(rng.below(3));
    cell.size = cell.measure == Measure::relative ? rng.uniform(0, 0.5) : rng.uniform(0.05, 4);
    return cell;
  };
  for (int trial = 0; trial < 20'000; ++trial) {
    const double length = rng.uniform(0.1, 40);
    std::vector<Cell> cells;
    const std::uint32_t top = 1 + rng.below(4);
    for (std::uint32_t i = 0; i < top; ++i) cells.push_back(random_cell());
    bool floats = false;
    for (std::uint32_t i = 0; i < top; ++i) {
      if (rng.below(3) == 0) {
        cells[i] = {
            .is_group = true, .first = static_cast<std::uint32_t>(cells.size()), .count = 1 + rng.below(3)};
        const std::uint32_t count = cells[i].count, first = cells[i].first;
        for (std::uint32_t k = 0; k < count; ++k) cells.push_back(random_cell());
        if (rng.below(3) == 0) {
          const auto inner = static_cast<std::uint32_t>(cells.size());
          cells.push_back(random_cell());
          cells[first] = {.is_group = true, .first = inner, .count = 1};
        }
      } else {
        floats |= cells[i].measure == Measure::floating;
      }
    }
    std::vector<Cut> cuts;
    double wanted = 0;
    ASSERT_TRUE(cut(cells, top, length, {Rounding::nearest, 1e7}, cuts, wanted));
    double at = 0;
    for (const Cut& each : cuts) {
      ASSERT_NEAR(each.start, at, 1e-9 * length) << "trial " << trial;
      ASSERT_GT(each.size, 0);
      at = each.start + each.size;
    }
    ASSERT_LE(at, length * (1 + 1e-12));
    double fixed = 0;
    bool has_groups = false;
    for (std::uint32_t i = 0; i < top; ++i) {
      has_groups |= cells[i].is_group;
      if (!cells[i].is_group && cells[i].measure != Measure::floating)
        fixed += cells[i].measure == Measure::relative ? cells[i].size * length : cells[i].size;
    }
    if (floats && !has_groups && fixed < length) {
      ASSERT_NEAR(at, length, 1e-8 * length) << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace seedmesh::building
