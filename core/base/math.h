#pragma once
/// The transcendental functions of core. They wrap the deterministic scalar functions of SLEEF (Shibata and
/// Petrogalli, "SLEEF: A Portable Vectorized Library of C Standard Mathematical Functions", 2020), which give
/// the same bits on every CPU; libm does not. Angles are in radians. Errors are at most 1.0 ulp. `std::sqrt`,
/// `floor` and `fabs` are exact by IEEE 754 and may be used directly.
#include <cstdint>
#include <glm/vec3.hpp>

namespace seedmesh::math {

constexpr double pi = 3.14159265358979323846;

struct SinCos {
  double sin, cos;
};

double sin(double x);
double cos(double x);
SinCos sincos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double pow(double x, double y);
double cbrt(double x);

/// Sine and cosine of an angle in degrees; exact at multiples of 90 degrees, so that right angles stay right.
SinCos sincos_degrees(double degrees);

constexpr double radians(double degrees) { return degrees * (pi / 180); }
constexpr double degrees(double radians) { return radians * (180 / pi); }

/// Returns `x` rounded toward zero and clamped to the range of the type; NaN gives 0. The plain cast is undefined
/// out of range, and its result then differs between x86 and ARM.
std::int64_t to_int64(double x);
std::int32_t to_int32(double x);
std::uint32_t to_uint32(double x);

/// Returns the unit vector along `v`, or `otherwise` where v is zero or not finite. Divides by the correctly rounded
/// root. glm::normalize multiplies by a reciprocal instead, which loses the last bits.
glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& otherwise);
glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise);

}  // namespace seedmesh::math
