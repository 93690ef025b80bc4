#include "core/geom/plant/key_sums.h"

#include <gtest/gtest.h>

#include <map>

namespace seedmesh {
namespace {

TEST(KeySums, AreThoseOfAMap) {
  const Job job(1, Job::Options{});
  KeySums sums(job);
  std::map<std::uint64_t, double> wanted;
  EXPECT_EQ(sums.at(0), 0);
  Rng rng = Rng::of_seed(4);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t key = rng.below(5'000) * 0x100000000ULL;
    const double amount = rng.unit();
    sums.add(key, amount);
    wanted[key] += amount;
  }
  sums.add(7, 0);
  for (const auto& [key, sum] : wanted) ASSERT_EQ(sums.at(key), sum) << key;
  EXPECT_EQ(sums.at(7), 0);
  EXPECT_EQ(sums.at(1), 0);
  sums.clear();
  for (const auto& [key, sum] : wanted) ASSERT_EQ(sums.at(key), 0) << key;
  sums.add(1, 2);
  EXPECT_EQ(sums.at(1), 2);
}

}  // namespace
}  // namespace seedmesh
