#pragma once
/// Sine, cosine and arctangent in single precision, for loops that the compiler vectorises. The error is below
/// 3e-7. They use only additions, products and quotients, so the bits are the same on every machine.
///
/// Polynomials of Cephes (S. Moshier, sinf.c and atanf.c, 1989).
#include <cmath>

namespace seedmesh::math {

struct FloatSinCos {
  float sin = 0, cos = 1;
};

/// Rounds to the nearest whole number, ties to even. |x| must be below a quarter of the greatest whole number
/// that the type represents exactly.
inline float nearest(float x) { return (x + 0x1.8p23F) - 0x1.8p23F; }
inline double nearest(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

namespace quick {

/// Returns sine and cosine of the angle rest + quarters * pi / 2. `rest` is from -pi/4 to pi/4; `quarters` is -2,
/// -1, 0, 1 or 2.
inline FloatSinCos turned(float rest, float quarters) {
  const float z = rest * rest;
  const float sine = rest + rest * z * (-1.6666654611e-1F + z * (8.3321608736e-3F + z * -1.9515295891e-4F));
  const float cosine =
      1 - 0.5F * z +
      z * z * (4.166664568298827e-2F + z * (-1.388731625493765e-3F + z * 2.443315711809948e-5F));
  const bool is_odd = std::abs(std::abs(quarters) - 1) < 0.5F;
  const float first = is_odd ? cosine : sine, second = is_odd ? sine : cosine;
  const bool is_below = (quarters < -0.5F) | (quarters > 1.5F);
  const bool is_left = (quarters > 0.5F) | (quarters < -1.5F);
  return {is_below ? -first : first, is_left ? -second : second};
}

/// Reduces a whole number of quarter turns modulo 4 to -2, -1, 0, 1 or 2.
inline float reduced_quarters(float quarters) { return quarters - 4 * nearest(0.25F * quarters); }
inline double reduced_quarters(double quarters) { return quarters - 4 * nearest(0.25 * quarters); }

}  // namespace quick

/// Sine and cosine of `x` radians, for angles up to some hundred turns.
inline FloatSinCos quick_sincos(float x) {
  const float quarters = nearest(x * 0.636619772F);
  const float rest =
      ((x - quarters * 1.5703125F) - quarters * 4.837512969970703125e-4F) - quarters * 7.54978995489e-8F;
  return quick::turned(rest, quick::reduced_quarters(quarters));
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90 degrees.
inline FloatSinCos quick_float_sincos_degrees(double degrees) {
  const double quarters = nearest(degrees * (1.0 / 90));
  const auto rest = static_cast<float>((degrees - 90 * quarters) * 0.017453292519943295);
  return quick::turned(rest, static_cast<float>(quick::reduced_quarters(quarters)));
}

/// Returns the angle of (x, y) in [-pi, pi]; 0 for (0, 0).
inline float quick_atan2(float y, float x) {
  constexpr float half_turn = 3.14159265F;
  const float a = std::abs(x), b = std::abs(y), most = a > b ? a : b, least = a > b ? b : a;
  const bool is_steep = least > 0.414213562F * most;
  const float above = is_steep ? least - most : least, below = is_steep ? least + most : most;
  const float t = above / (below > 0 ? below : 1);
  const float z = t * t;
  const float series = t + t * z *
                               (-3.33329491539e-1F +
                                z * (1.99777106478e-1F + z * (-1.38776856032e-1F + z * 8.05374449538e-2F)));
  const float first = is_steep ? 0.25F * half_turn + series : series;
  const float second = b > a ? 0.5F * half_turn - first : first;
  const float angle = x < 0 ? half_turn - second : second;
  return y < 0 ? -angle : angle;
}

}  // namespace seedmesh::math
