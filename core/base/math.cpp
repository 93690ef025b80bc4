#include "core/base/math.h"

#include <sleef.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/quick_math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace math {

double sin(double x) { return Sleef_cinz_sind1_u10purec(x); }
double cos(double x) { return Sleef_cinz_cosd1_u10purec(x); }
SinCos sincos(double x) {
  const auto pair = Sleef_cinz_sincosd1_u10purec(x);
  return {pair.x, pair.y};
}
double tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
double cbrt(double x) { return Sleef_cinz_cbrtd1_u10purec(x); }

SinCos sincos_degrees(double degrees) {
  const double quarter = std::floor(degrees / 90);
  const double rest = degrees - quarter * 90;
  const SinCos base = rest == 0 ? SinCos{0, 1} : sincos(radians(rest));
  switch (to_int64(quarter - 4 * std::floor(quarter / 4))) {
    case 0:
      return base;
    case 1:
      return {base.cos, -base.sin};
    case 2:
      return {-base.sin, -base.cos};
    default:
      return {-base.cos, base.sin};
  }
}

namespace {
template <class Int>
Int clamp_to(double x) {
  if (x != x) return 0;
  // 2^63 and 2^31 are exact in a double, their predecessors are not always: compare against the power.
  constexpr Int half = std::numeric_limits<Int>::max() / 2 + 1;
  constexpr double high = 2.0 * static_cast<double>(half);
  constexpr double low = static_cast<double>(std::numeric_limits<Int>::min());
  if (x >= high) return std::numeric_limits<Int>::max();
  if (x <= low) return std::numeric_limits<Int>::min();
  return static_cast<Int>(x);
}
}  // namespace

std::int64_t to_int64(double x) { return clamp_to<std::int64_t>(x); }
std::int32_t to_int32(double x) { return clamp_to<std::int32_t>(x); }
std::uint32_t to_uint32(double x) { return clamp_to<std::uint32_t>(x); }

glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& otherwise) {
  return unit_or(v, [&] { return otherwise; });
}
glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
  return unit_or(v, [&] { return otherwise; });
}

}  // namespace math

double normal(Rng& rng, double mean, double deviation) {
  for (int attempt = 0; attempt < 64; ++attempt) {  // each attempt succeeds with probability pi/4
    const double x = rng.uniform(-1, 1);
    const double y = rng.uniform(-1, 1);
    const double s = x * x + y * y;
    if (s > 0 && s < 1) return mean + deviation * x * std::sqrt(-2 * math::log(s) / s);
  }
  return mean;
}

}  // namespace seedmesh
