#include "core/generators/tree/weber_penn_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/math.h"

namespace seedmesh::tree {
namespace {

// Flares up to this have the profile of the paper. Wider ones use a smaller base of the power, down to the
// second.
constexpr double widest_steep_flare = 1.25, least_flare_base = 9;

constexpr double root_half = 0.70710678118654752440, log2_e = 1.44269504088896340736,
                 log_2 = 0.69314718055994530942;

/// Uses series of the logarithm about 1 and of the exponential function about 0.
double series_power(double base, double exponent) {
  const auto bits = std::bit_cast<std::uint64_t>(base);
  const double mantissa = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFU) | 0x3FE0000000000000U);
  const bool is_low = mantissa < root_half;
  const double one = is_low ? 2 * mantissa : mantissa;
  const auto doublings = static_cast<std::int32_t>(bits >> 52U) - (is_low ? 1023 : 1022);
  const double s = (one - 1) / (one + 1), z = s * s;
  const double log =
      2 * s *
      (1 + z * (1.0 / 3 +
                z * (1.0 / 5 +
                     z * (1.0 / 7 + z * (1.0 / 9 + z * (1.0 / 11 + z * (1.0 / 13 + z * (1.0 / 15))))))));
  const double exact = exponent * (doublings + log * log2_e), whole = std::floor(exact + 0.5);
  const double r = (exact - whole) * log_2;
  double sum = 1.0 / 3'628'800;
  for (const double each :
       {1.0 / 362'880, 1.0 / 40'320, 1.0 / 5'040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0})
    sum = each + r * sum;
  const auto scale = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52U;
  return sum * std::bit_cast<double>(scale);
}

}  // namespace

std::array<WeberPennLevel, 4> weber_penn_levels(const TreeParams& p) {
  std::array<WeberPennLevel, 4> levels{{
      {0, 0, 0, 0, 0, 1, 1, 0, p.length_0, p.length_v_0, p.taper_0, p.seg_splits_0, p.split_angle_0,
       p.split_angle_v_0, p.curve_res_0, p.curve_0, p.curve_back_0, p.curve_v_0},
      {p.down_angle_1, p.down_angle_v_1, p.rotate_1, p.rotate_v_1, p.branches_1, p.branch_dist_1, p.whorl_1,
       p.base_size_1, p.length_1, p.length_v_1, p.taper_1, p.seg_splits_1, p.split_angle_1, p.split_angle_v_1,
       p.curve_res_1, p.curve_1, p.curve_back_1, p.curve_v_1},
      {p.down_angle_2, p.down_angle_v_2, p.rotate_2, p.rotate_v_2, p.branches_2, p.branch_dist_2, p.whorl_2,
       p.base_size_2, p.length_2, p.length_v_2, p.taper_2, p.seg_splits_2, p.split_angle_2, p.split_angle_v_2,
       p.curve_res_2, p.curve_2, p.curve_back_2, p.curve_v_2},
      {p.down_angle_3, p.down_angle_v_3, p.rotate_3, p.rotate_v_3, p.branches_3, p.branch_dist_3, p.whorl_3,
       p.base_size_3, p.length_3, p.length_v_3, p.taper_3, p.seg_splits_3, p.split_angle_3, p.split_angle_v_3,
       p.curve_res_3, p.curve_3, p.curve_back_3, p.curve_v_3},
  }};
  for (WeberPennLevel& level : levels) level.curve_res = std::max(1, level.curve_res);
  return levels;
}

double power(double base, double exponent) {
  if (exponent == 2) return base * base;
  if (exponent == 0.5) return std::sqrt(base);
  if (exponent == 1) return base;
  // The series is not valid near the limits of doubles.
  const bool is_usual = base > 1e-30 && base < 1e30 && std::abs(exponent) < 8;
  return is_usual ? series_power(base, exponent) : math::pow(base, exponent);
}

double shape_ratio(const TreeParams& params, int shape, double ratio) {
  const double r = std::clamp(ratio, 0.0, 1.0);
  switch (shape) {
    case 0:
      return params.counting == TreeParams::Counting::arbaro ? r : 0.2 + 0.8 * r;
    case 1:
      return 0.2 + 0.8 * math::sin(math::pi * r);
    case 2:
      return 0.2 + 0.8 * math::sin(0.5 * math::pi * r);
    case 3:
      return 1;
    case 4:
      return 0.5 + 0.5 * r;
    case 5:
      return r <= 0.7 ? r / 0.7 : (1 - r) / 0.3;
    case 6:
      return 1 - 0.8 * r;
    case 7:
      return r <= 0.7 ? 0.5 + 0.5 * r / 0.7 : 0.5 + 0.5 * (1 - r) / 0.3;
    default:
      break;
  }
  // The paper divides both parts by 1 - peak, which gives a step unless the peak is in the middle.
  if (ratio < 0 || ratio > 1) return 0;
  const double peak = 1 - params.PruneWidthPeak;
  if (r < peak) return power(r / peak, params.PrunePowerHigh);
  return peak >= 1 ? 1 : power((1 - r) / (1 - peak), params.PrunePowerLow);
}

double tapered(double taper, double radius, double length, double z) {
  const double unit = taper < 1 ? taper : taper < 2 ? 2 - taper : 0;
  const double cone = radius * (1 - unit * z);
  if (taper < 1 || cone <= 0) return std::max(0.0, cone);
  const double to_end = (1 - z) * length;
  const double depth = taper < 2 || to_end < cone ? 1 : taper - 2;
  const double aside =
      taper < 2 ? to_end : std::abs(to_end - 2 * cone * std::floor(to_end / (2 * cone) + 0.5));
  if (taper < 2 && aside >= cone) return cone;
  const double round = cone * cone - (aside - cone) * (aside - cone);
  return (1 - depth) * cone + depth * std::sqrt(std::max(0.0, round));
}

double flared(double flare, double z) {
  const double y = std::max(0.0, 1 - 8 * z), excess = flare - widest_steep_flare;
  if (flare == 0 || y == 0) return 1;
  if (!(excess > 0)) return 1 + flare * (math::pow(100, y) - 1) / 100;
  // With the base 100 of the paper, a wide flare would be a flat disc.
  const double base = std::max(least_flare_base, 100 / ((1 + 4 * excess) * (1 + 4 * excess)));
  return 1 + 0.99 * flare * (math::pow(base, y) - 1) / (base - 1);
}

double flared_trunk(const TreeParams& params, double z) {
  const double own = params.Flare, more = params.trunk_flare;
  if (own <= 0 || more <= 0) return flared(own, z) * flared(more, z);
  return flared(own + more + 0.99 * own * more, z);
}

namespace {

/// Bernoulli's bounds of base^power for a base in 0 .. 1, widened by 1e-9. They decide for most points
/// whether they are within the envelope, without the cost of a power.
struct PowerBounds {
  double low = 0, high = 1 + 1e-9;
};
PowerBounds bounds_of_power(double base, double power) {
  PowerBounds bounds;
  if (power > 1 || base <= 0) return bounds;
  bounds.low = (1 - 1e-9) / (1 + power * (1 / base - 1));
  bounds.high = (1 + 1e-9) * (1 - power * (1 - base));
  return bounds;
}

}  // namespace

bool is_in_envelope(const TreeParams& params, double scale, double aside, double height) {
  const double ratio = (scale - height) / (scale * (1 - params.BaseSize));
  if (ratio > 0 && ratio < 1) {
    const double peak = 1 - params.PruneWidthPeak;
    const bool is_above = ratio < peak;
    const PowerBounds bounds = is_above    ? bounds_of_power(ratio / peak, params.PrunePowerHigh)
                               : peak >= 1 ? PowerBounds{}
                                           : bounds_of_power((1 - ratio) / (1 - peak), params.PrunePowerLow);
    const double width = aside / scale;
    if (width < params.PruneWidth * bounds.low) return true;
    if (width >= params.PruneWidth * bounds.high) return false;
  }
  return aside / scale < params.PruneWidth * shape_ratio(params, 8, ratio);
}

double declination_of(const Frame& frame) {
  return math::degrees(math::quick_acos(std::clamp(frame.heading.y, -1.0, 1.0)));
}

}  // namespace seedmesh::tree
