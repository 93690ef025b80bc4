#include "core/generators/city/edge_table.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace seedmesh::city {
namespace {

TEST(EdgeTable, FindsTheFirstOfEqualEdgesAsAMapDoes) {
  constexpr int count = 100'000;
  constexpr std::int32_t range = 200;  // many edges are equal
  Rng draw(7);
  const auto point = [&draw] {
    return CmPoint{static_cast<std::int32_t>(draw.below(range)) - range / 2,
                   static_cast<std::int32_t>(draw.below(5))};
  };
  EdgeTable table(count);
  std::map<std::pair<CmPoint, CmPoint>, std::uint32_t> expected;
  for (std::uint32_t i = 0; i < count; ++i) {
    const CmPoint a = point(), b = point();
    table.add(a, b, i);
    expected.try_emplace({a, b}, i);
  }
  for (int i = 0; i < count; ++i) {
    const CmPoint a = point(), b = point();
    const auto found = expected.find({a, b});
    ASSERT_EQ(table.value_of(a, b), found == expected.end() ? EdgeTable::absent : found->second);
  }
}

TEST(EdgeTable, FindsNothingWhenEmpty) { EXPECT_EQ(EdgeTable().value_of({1, 2}, {3, 4}), EdgeTable::absent); }

}  // namespace
}  // namespace seedmesh::city
