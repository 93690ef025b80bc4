#include "core/generators/world/valley.h"

#include <algorithm>

namespace seedmesh::world {
namespace {

constexpr double first_return = 0.12;  ///< share of the reach from which the valley returns to the land
constexpr double slope_blend =
    24;  ///< metres of height over which the slope of a valley becomes that of the land

constexpr double most_blend = 24;  ///< metres
constexpr double steep_from =
    90;  ///< metres beyond the flood plain where the slope of a side is that of its height

/// Metres of height over which a valley meets the land. Small beside the water, so that the rounding never cuts the
/// bank below the water.
double blend_at(double from_bank) {
  constexpr double least = 2, by = 0.04;
  return std::min(most_blend, least + by * from_bank);
}

/// The height of the side before it meets the land.
double plain_side(const WatersidePoint& waterside, double slope) {
  const double flat = 40 + 8 * waterside.half_width;
  return waterside.water + 1 + 0.02 * waterside.distance + slope * std::max(0.0, waterside.distance - flat);
}

double slope_of_side(double ruggedness) { return 0.16 + 0.36 * ruggedness; }

}  // namespace

bool is_above(double height, double land, double ruggedness, const WatersidePoint& waterside) {
  if (waterside.distance >= valley_reach) return true;
  const double side = plain_side(waterside, slope_of_side(ruggedness));
  // where the side is above the land by the blend, the valley is the land; elsewhere a quarter of the blend is cut
  return side >= land + most_blend || std::min(land, side) - most_blend / 4 >= height;
}

double steepest_side(double ruggedness, double deep) {
  constexpr double steepest_return = 1.5 / (1 - first_return);
  const double slope = slope_of_side(ruggedness);
  return 0.02 + slope * smooth_step(deep / slope, 0, steep_from) + deep * steepest_return / valley_reach;
}

double lowest_side(const WatersidePoint& waterside) {
  return plain_side(waterside, slope_of_side(0)) - most_blend / 4;
}

ValleySide valley_side(double land, double ruggedness, const WatersidePoint& waterside) {
  const double away = waterside.distance;
  if (away >= valley_reach) return {land, 1, 0};
  const double slope = slope_of_side(ruggedness);
  const double beyond = std::max(0.0, away - (40 + 8 * waterside.half_width));
  const double side = plain_side(waterside, slope);
  const double blend = blend_at(std::max(0.0, away - waterside.half_width));
  const double overlap = std::max(0.0, blend - std::abs(land - side));
  const double low = std::min(land, side) - overlap * overlap / (4 * blend);
  const Slope back = smooth_step(Slope{away * (1 / valley_reach), 1 / valley_reach, 0}, first_return, 1);
  const double own = std::clamp((side - land) / (2 * slope_blend) + 0.5, 0.0, 1.0);
  return {low + back.value * (land - low), 1 - (1 - own) * (1 - back.value),
          (0.02 + slope * smooth_step(beyond, 0, steep_from)) * (1 - back.value) + back.east * (land - low)};
}

}  // namespace seedmesh::world
