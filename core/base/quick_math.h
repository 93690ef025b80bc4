#pragma once
/// Inline sine, cosine, arctangent and arccosine for inner loops; elsewhere use math.h. They take a fifth of
/// the time of SLEEF's functions. Errors are at most 2e-15 for arguments below 100,000. The bits are the same
/// everywhere: only additions, products, quotients and roots are used, which IEEE 754 rounds correctly and
/// the build does not contract.
///
/// Sources: polynomials of FDLIBM (Sun Microsystems, 1993) for sine and cosine up to an eighth of a turn; the
/// rational function of Cephes (S. Moshier, 1989) for the arctangent up to 0.66.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::math {

namespace quick {

/// Sine and cosine of an angle `r` of at most an eighth of a turn.
inline SinCos kernel(double r) {
  const double z = r * r;
  const double sine =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 +
                              z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const double cosine =
      1 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  return {sine, cosine};
}

/// Returns the kernel's result turned by `quarters` quarter turns. Selects instead of branching, because
/// branches on the quarter cannot be predicted and would prevent vectorisation.
inline SinCos turned(const SinCos& a, double quarters) {
  const double rest = quarters - 4 * std::floor(0.25 * quarters);
  const bool is_odd = (rest > 0.5) & ((rest < 1.5) | (rest > 2.5));
  const double sine = is_odd ? a.cos : a.sin, cosine = is_odd ? a.sin : a.cos;
  const bool is_left = (rest > 0.5) & (rest < 2.5);
  return {rest > 1.5 ? -sine : sine, is_left ? -cosine : cosine};
}

}  // namespace quick

/// Returns sine and cosine of `x` radians, with the error stated above.
inline SinCos quick_sincos(double x) {
  const double quarters = std::floor(x * (2 / pi) + 0.5);
  const double rest = (x - quarters * 1.57079632673412561417e+00) - quarters * 6.07710050650619224932e-11;
  return quick::turned(quick::kernel(rest), quarters);
}

/// Returns sine and cosine of an angle in degrees; exact at multiples of 90 degrees.
inline SinCos quick_sincos_degrees(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  return quick::turned(quick::kernel((degrees - 90 * quarters) * (pi / 180)), quarters);
}

/// Returns the angle of (x, y) in (-pi, pi]; 0 for (0, 0).
inline double quick_atan2(double y, double x) {
  const double a = std::abs(x), b = std::abs(y), most = a > b ? a : b, least = a > b ? b : a;
  const double share = least / (most > 0 ? most : 1);
  const bool is_steep = share > 0.41421356237309503;
  const double t = (is_steep ? share - 1 : share) / (is_steep ? share + 1 : 1);
  const double z = t * t;
  const double above =
      (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
       1.228866684490136173410e2) *
          z -
      6.485021904942025371773e1;
  const double below =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) *
           z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  const double first = (is_steep ? 0.25 * pi : 0) + (t + t * (z * above / below));
  const double second = b > a ? 0.5 * pi - first : first;
  const double angle = x < 0 ? pi - second : second;
  return most > 0 ? (y < 0 ? -angle : angle) : 0;
}

/// Returns the angle in [0, pi] whose cosine is `x`, from -1 to 1.
inline double quick_acos(double x) {
  const double rest = 1 - x * x;
  return quick_atan2(std::sqrt(rest > 0 ? rest : 0), x);
}

/// Returns the same bits as math::unit, and is inline. Calls `otherwise()` only where `v` is zero or not
/// finite.
template <class Vec, class Otherwise>
Vec unit_or(const Vec& v, const Otherwise& otherwise) {
  const auto largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return otherwise();
  const Vec scaled = v / largest;  // keeps the squares inside the range of the type
  const auto length = std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
  return scaled / length;
}

/// math::unit with a fast path for vectors whose squared length is between 1e-30 and 1e30.
inline glm::vec3 quick_unit(const glm::vec3& v, const glm::vec3& otherwise) {
  const float square = v.x * v.x + v.y * v.y + v.z * v.z;
  if (!(square > 1e-30F && square < 1e30F)) return unit(v, otherwise);
  const float length = std::sqrt(square);
  return {v.x / length, v.y / length, v.z / length};
}

}  // namespace seedmesh::math
