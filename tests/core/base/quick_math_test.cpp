#include "core/base/quick_math.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace seedmesh::math {
namespace {

TEST(QuickMath, IsWithinAFewBitsOfTheExactFunctions) {
  Rng rng(3);
  for (int i = 0; i < 20'000; ++i) {
    const double x = rng.uniform(-2000, 2000);
    const SinCos quick = quick_sincos(x), exact = sincos(x);
    EXPECT_NEAR(quick.sin, exact.sin, 5e-14);
    EXPECT_NEAR(quick.cos, exact.cos, 5e-14);
    const double near = rng.uniform(-10, 10);
    EXPECT_NEAR(quick_sincos(near).sin, sincos(near).sin, 2e-15);
    const double y = rng.uniform(-3, 3), z = rng.uniform(-3, 3);
    EXPECT_NEAR(quick_atan2(y, z), atan2(y, z), 2e-15);
    const double c = rng.uniform(-1, 1);
    EXPECT_NEAR(quick_acos(c), acos(c), 1e-14);
  }
}

TEST(QuickMath, KeepsRightAnglesRight) {
  for (int quarters = -9; quarters <= 9; ++quarters) {
    const SinCos quick = quick_sincos_degrees(90.0 * quarters), exact = sincos_degrees(90.0 * quarters);
    EXPECT_EQ(quick.sin, exact.sin);
    EXPECT_EQ(quick.cos, exact.cos);
  }
}

TEST(QuickMath, IsExactForTheAxesAndForNoDirection) {
  EXPECT_EQ(quick_atan2(0, 0), 0);
  EXPECT_EQ(quick_atan2(0, 1), 0);
  EXPECT_EQ(quick_atan2(0, -1), pi);
  EXPECT_EQ(quick_atan2(1, 0), 0.5 * pi);
  EXPECT_EQ(quick_atan2(-1, 0), -0.5 * pi);
  EXPECT_EQ(quick_acos(1), 0);
}

}  // namespace
}  // namespace seedmesh::math
