#include "core/base/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seedmesh {
namespace {

TEST(Math, TurnsRightAnglesWithoutError) {
  EXPECT_EQ(math::sincos_degrees(90).sin, 1);
  EXPECT_EQ(math::sincos_degrees(90).cos, 0);
  EXPECT_EQ(math::sincos_degrees(180).cos, -1);
  EXPECT_EQ(math::sincos_degrees(-90).sin, -1);
  EXPECT_EQ(math::sincos_degrees(810).sin, 1);
  EXPECT_NEAR(math::sincos_degrees(30).sin, 0.5, 1e-15);
}

TEST(Math, AgreesWithTheStandardLibraryToItsLastBits) {
  for (double x = -20; x < 20; x += 0.37) {
    EXPECT_NEAR(math::sin(x), std::sin(x), 2e-16);
    EXPECT_NEAR(math::exp(x), std::exp(x), 4e-16 * std::exp(x));
    EXPECT_NEAR(math::atan2(x, 3), std::atan2(x, 3), 4e-16);
  }
}

TEST(Math, ClampsWhatAnIntegerCannotHold) {
  EXPECT_EQ(math::to_int32(1e300), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(math::to_int32(-1e300), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(math::to_int64(std::nan("")), 0);
  EXPECT_EQ(math::to_uint32(-5), 0U);
  EXPECT_EQ(math::to_uint32(4294967295.0), 4294967295U);
  EXPECT_EQ(math::to_int64(9.3e18), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(math::to_int32(-2.9), -2);
}

TEST(Math, MakesUnitVectorsOfVerySmallAndVeryLargeOnes) {
  const glm::dvec3 up{0, 1, 0};
  EXPECT_EQ(math::unit(glm::dvec3(0, 0, 1e-300), up), glm::dvec3(0, 0, 1));
  EXPECT_EQ(math::unit(glm::dvec3(-1e300, 0, 0), up), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(math::unit(glm::dvec3(0), up), up);
}

}  // namespace
}  // namespace seedmesh
