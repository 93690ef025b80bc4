#include "core/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

TEST(DisjointSets, HaveTheLeastMemberOfAllThatAreJoined) {
  constexpr std::uint32_t count = 200;
  DisjointSets sets(count);
  std::vector<std::uint32_t> least(count);  // by relabelling all members at each join
  for (std::uint32_t i = 0; i < count; ++i) least[i] = i;
  const Rng rng(7);
  for (std::uint64_t k = 0; k < 150; ++k) {
    const auto a = static_cast<std::uint32_t>(rng.at("a").at(k).key() % count);
    const auto b = static_cast<std::uint32_t>(rng.at("b").at(k).key() % count);
    const std::uint32_t low = std::min(least[a], least[b]), high = std::max(least[a], least[b]);
    EXPECT_EQ(sets.join(a, b), low != high);
    for (std::uint32_t& each : least) each = each == high ? low : each;
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sets.of(i), least[i]) << k << ' ' << i;
  }
}

TEST(DisjointSets, AddASetOfOneNumber) {
  DisjointSets sets;
  EXPECT_EQ(sets.add(), 0U);
  EXPECT_EQ(sets.add(), 1U);
  EXPECT_EQ(sets.size(), 2U);
  EXPECT_TRUE(sets.join(1, 0));
  EXPECT_FALSE(sets.join(0, 1));
  EXPECT_EQ(sets.of(1), 0U);
}

}  // namespace
}  // namespace seedmesh
