#include "core/base/rng.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(Rng, GivesEachKeyItsOwnStream) {
  const Rng root = Rng::of_seed(7);
  Rng left = root.at("limb").at(0), right = root.at("limb").at(1), again = root.at("limb").at(0);
  EXPECT_NE(left.next(), right.next());
  left = root.at("limb").at(0);
  EXPECT_EQ(left.next(), again.next());
}

TEST(Rng, DrawsEvenlyFromTheUnitInterval) {
  Rng rng = Rng::of_seed(1);
  double sum = 0, low = 1, high = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = rng.unit();
    sum += x;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  EXPECT_NEAR(sum / 100'000, 0.5, 0.005);
  EXPECT_GE(low, 0);
  EXPECT_LT(high, 1);
}

TEST(Rng, DrawsNormalDeviatesOfTheGivenSpread) {
  Rng rng = Rng::of_seed(2);
  double sum = 0, squares = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = normal(rng, 3, 2);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / 100'000;
  EXPECT_NEAR(mean, 3, 0.03);
  EXPECT_NEAR(squares / 100'000 - mean * mean, 4, 0.08);
}

TEST(Rng, StaysTheSameForEver) {  // a change here changes what every seed yields
  Rng rng = Rng::of_seed(0).at("leaf").at(3);
  const std::uint64_t first = rng.next();
  EXPECT_EQ(first, Rng::of_seed(0).at("leaf").at(3).next());
}

}  // namespace
}  // namespace seedmesh
