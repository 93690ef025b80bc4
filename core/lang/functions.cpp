/// The built-in functions that grammars for cpfg, ABOP and CGA use. Operations that IEEE 754 does not define exactly
/// come from core/base/math.h.
#include <cmath>
#include <limits>

#include "core/base/math.h"
#include "core/lang/expression.h"

namespace seedmesh::lang {

double modulo(double dividend, double divisor) {
  constexpr double exact = 2147483648.0;  // below it, the floor of a rounded quotient of integers is right
  const bool integers = std::abs(dividend) < exact && std::abs(divisor) < exact && divisor != 0 &&
                        std::floor(dividend) == dividend && std::floor(divisor) == divisor;
  if (integers) return dividend - divisor * std::floor(dividend / divisor);
  const double rest = std::fmod(dividend, divisor);  // exact, so the same on every machine
  return rest != 0 && (rest < 0) != (divisor < 0) ? rest + divisor : rest;
}

double power(double base, double exponent) {
  return exponent == 2 ? base * base : math::pow(base, exponent);  // most powers are squares
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Makes sines and cosines of exactly 1/2 exact, because grammars compare them: angles of `special` and of 180 -
/// `special` degrees. Adding 0 turns -0 into 0.
double with_exact_half(double value, double degrees, double special) {
  if (std::abs(std::abs(value) - 0.5) < 1e-15) {
    const double half_turn = modulo(degrees, 180);
    if (half_turn == special || half_turn == 180 - special) return std::copysign(0.5, value);
  }
  return value + 0.0;
}

double sine(double degrees) { return with_exact_half(math::sincos_degrees(degrees).sin, degrees, 30); }
double cosine(double degrees) { return with_exact_half(math::sincos_degrees(degrees).cos, degrees, 60); }

double tangent(double degrees) {
  const double half_turn = modulo(degrees, 180);
  if (half_turn == 45) return 1;
  if (half_turn == 90) return infinity;
  if (half_turn == 135) return -1;
  const math::SinCos pair = math::sincos_degrees(degrees);
  return pair.sin / pair.cos + 0.0;
}

double arc_sine(double x) { return std::abs(x) == 0.5 ? 60 * x : math::degrees(math::asin(x)); }
double arc_cosine(double x) { return std::abs(x) == 0.5 ? 90 - 60 * x : math::degrees(math::acos(x)); }
double arc_tangent(double y, double x) { return math::degrees(math::atan2(y, x)); }

double decimal_logarithm(double x) {
  constexpr double ln_10 = 2.30258509299404568402;
  const double value = math::log(x) / ln_10;
  const double whole = std::round(value);
  return math::pow(10, whole) == x ? whole : value;
}

double round_to_even(double x) {
  const double whole = std::round(x);
  const bool halfway = std::abs(x - std::trunc(x)) == 0.5;
  return halfway ? 2 * std::round(x / 2) : whole;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }  // keeps 0 and NaN
double least(double a, double b) { return b < a ? b : a; }
double greatest(double a, double b) { return a < b ? b : a; }

using Arguments = const double*;

constexpr Function table[] = {
    {"sin", 1, "angle", "Sine of an angle in degrees.", "sin(30)",
     [](Arguments a, Rng&) { return sine(a[0]); }, false},
    {"cos", 1, "angle", "Cosine of an angle in degrees.", "cos(60)",
     [](Arguments a, Rng&) { return cosine(a[0]); }, false},
    {"tan", 1, "angle", "Tangent of an angle in degrees; infinite at 90.", "tan(45)",
     [](Arguments a, Rng&) { return tangent(a[0]); }, false},
    {"asin", 1, "x", "Angle from -90 to 90 degrees whose sine is x.", "asin(1)",
     [](Arguments a, Rng&) { return arc_sine(a[0]); }, false},
    {"acos", 1, "x", "Angle from 0 to 180 degrees whose cosine is x.", "acos(0.5)",
     [](Arguments a, Rng&) { return arc_cosine(a[0]); }, false},
    {"atan", 1, "x", "Angle from -90 to 90 degrees whose tangent is x.", "atan(1)",
     [](Arguments a, Rng&) { return arc_tangent(a[0], 1); }, false},
    {"atan2", 2, "y, x", "Angle from -180 to 180 degrees from the x axis to the point (x, y).",
     "atan2(1, -1)", [](Arguments a, Rng&) { return arc_tangent(a[0], a[1]); }, false},
    {"exp", 1, "x", "e to the power of x.", "exp(0)", [](Arguments a, Rng&) { return math::exp(a[0]); },
     false},
    {"log", 1, "x", "Natural logarithm.", "log(1)", [](Arguments a, Rng&) { return math::log(a[0]); }, false},
    {"ln", 1, "x", "Natural logarithm, as log.", "ln(1)", [](Arguments a, Rng&) { return math::log(a[0]); },
     false},
    {"log10", 1, "x", "Logarithm to base 10; exact for powers of ten.", "log10(1000)",
     [](Arguments a, Rng&) { return decimal_logarithm(a[0]); }, false},
    {"sqrt", 1, "x", "Square root.", "sqrt(2.25)", [](Arguments a, Rng&) { return std::sqrt(a[0]); }, false},
    {"pow", 2, "base, exponent", "Power, as base^exponent.", "pow(2, 10)",
     [](Arguments a, Rng&) { return power(a[0], a[1]); }, false},
    {"abs", 1, "x", "Absolute value.", "abs(-3)", [](Arguments a, Rng&) { return std::abs(a[0]); }, false},
    {"fabs", 1, "x", "Absolute value, as abs.", "fabs(-0.5)",
     [](Arguments a, Rng&) { return std::abs(a[0]); }, false},
    {"sign", 1, "x", "-1, 0 or 1, as x is negative, zero or positive.", "sign(-7)",
     [](Arguments a, Rng&) { return sign(a[0]); }, false},
    {"floor", 1, "x", "Greatest whole number that is not above x.", "floor(-1.5)",
     [](Arguments a, Rng&) { return std::floor(a[0]); }, false},
    {"ceil", 1, "x", "Least whole number that is not below x.", "ceil(1.2)",
     [](Arguments a, Rng&) { return std::ceil(a[0]); }, false},
    {"round", 1, "x", "Nearest whole number; halves go away from 0.", "round(2.5)",
     [](Arguments a, Rng&) { return std::round(a[0]); }, false},
    {"rint", 1, "x", "Nearest whole number; halves go to the even one.", "rint(2.5)",
     [](Arguments a, Rng&) { return round_to_even(a[0]); }, false},
    {"trunc", 1, "x", "x rounded towards 0 to a whole number.", "trunc(-1.5)",
     [](Arguments a, Rng&) { return std::trunc(a[0]); }, false},
    {"mod", 2, "dividend, divisor",
     "Remainder of the floored division, with the sign of the divisor, as the operator %.", "mod(-7, 3)",
     [](Arguments a, Rng&) { return modulo(a[0], a[1]); }, false},
    {"min", 2, "a, b", "The lesser.", "min(2, 3)", [](Arguments a, Rng&) { return least(a[0], a[1]); },
     false},
    {"max", 2, "a, b", "The greater.", "max(2, 3)", [](Arguments a, Rng&) { return greatest(a[0], a[1]); },
     false},
    {"clamp", 3, "x, low, high", "x, but at least low and at most high.", "clamp(7, 0, 5)",
     [](Arguments a, Rng&) { return least(greatest(a[0], a[1]), a[2]); }, false},
    {"lerp", 3, "a, b, t", "The value at share t of the way from a to b.", "lerp(10, 20, 0.25)",
     [](Arguments a, Rng&) { return a[0] + (a[1] - a[0]) * a[2]; }, false},
    {"select", 3, "condition, a, b", "a where the condition holds, else b; both are evaluated.",
     "select(2 > 1, 10, 20)", [](Arguments a, Rng&) { return a[0] != 0 ? a[1] : a[2]; }, false},
    {"isnan", 1, "x", "1 when x is not a number (0/0), else 0.", "isnan(0/0)",
     [](Arguments a, Rng&) { return std::isnan(a[0]) ? 1.0 : 0.0; }, false},
    {"isinf", 1, "x", "1 when x is infinite (1/0), else 0.", "isinf(1/0)",
     [](Arguments a, Rng&) { return std::isinf(a[0]) ? 1.0 : 0.0; }, false},
    {"ran", 1, "high", "Random, uniform from 0 to high (high itself excluded).", "ran(5)",
     [](Arguments a, Rng& rng) { return rng.uniform(0, a[0]); }, true},
    {"ran", 2, "low, high", "Random, uniform from low to high (high itself excluded).", "ran(2, 5)",
     [](Arguments a, Rng& rng) { return rng.uniform(a[0], a[1]); }, true},
    {"rand", 0, "", "Random, uniform from 0 to 1 (1 itself excluded).", "rand()",
     [](Arguments, Rng& rng) { return rng.unit(); }, true},
    {"rand", 1, "high", "Random, as ran.", "rand(5)",
     [](Arguments a, Rng& rng) { return rng.uniform(0, a[0]); }, true},
    {"rand", 2, "low, high", "Random, as ran.", "rand(2, 5)",
     [](Arguments a, Rng& rng) { return rng.uniform(a[0], a[1]); }, true},
    {"nran", 2, "mean, deviation", "Random, normally distributed.", "nran(10, 2)",
     [](Arguments a, Rng& rng) { return normal(rng, a[0], a[1]); }, true},
    {"p", 1, "probability", "1 with the given probability, else 0.", "p(0.25)",
     [](Arguments a, Rng& rng) { return rng.unit() < a[0] ? 1.0 : 0.0; }, true},
};

}  // namespace

std::span<const Function> functions() { return table; }

}  // namespace seedmesh::lang
