#pragma once
/// The surface of a valley beside its water, which the ground and the profiles of rivers share.
#include <algorithm>
#include <cmath>

#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Greatest distance in metres at which water changes the ground.
constexpr double valley_reach = 1400;

/// A position beside some water.
struct WatersidePoint {
  double distance = 0;    ///< metres from the middle of a river, or from the shore of a lake
  double half_width = 0;  ///< metres, of the river
  double water = 0;       ///< height of the water
};

struct ValleySide {
  double height = 0;  ///< at most that of the land
  double share = 1;   ///< share of the slope of the land that the slope of the ground has
  double along = 0;   ///< slope of the side, away from the water
};

namespace valley {

constexpr double first_return = 0.12;  ///< share of the reach from which the valley returns to the land
constexpr double slope_blend =
    24;  ///< metres of height over which the slope of a valley becomes that of the land

constexpr double most_blend = 24;  ///< metres
constexpr double steep_from =
    90;  ///< metres beyond the flood plain where the slope of a side is that of its height

/// Metres of height over which a valley meets the land. Small beside the water, so that the rounding never cuts the
/// bank below the water.
inline double blend_at(double from_bank) {
  constexpr double least = 2, by = 0.04;
  return std::min(most_blend, least + by * from_bank);
}

/// The height of the side before it meets the land.
inline double plain_side(const WatersidePoint& waterside, double slope) {
  const double flat = 40 + 8 * waterside.half_width;
  return waterside.water + 1 + 0.02 * waterside.distance + slope * std::max(0.0, waterside.distance - flat);
}

inline double slope_of_side(double ruggedness) { return 0.16 + 0.36 * ruggedness; }

}  // namespace valley

/// Whether valley_side() is certainly not below `height`, which is at most `land`. Takes less time than valley_side().
inline bool is_above(double height, double land, double ruggedness, const WatersidePoint& waterside) {
  if (waterside.distance >= valley_reach) return true;
  const double side = valley::plain_side(waterside, valley::slope_of_side(ruggedness));
  // where the side is above the land by the blend, the valley is the land; elsewhere a quarter of the blend is cut
  return side >= land + valley::most_blend || std::min(land, side) - valley::most_blend / 4 >= height;
}

/// Returns a lower bound, in metres, of the sides of valleys in land that is higher than this bound.
double lowest_side(const WatersidePoint& waterside);

/// Returns the steepest slope of the sides of valleys that are `deep` metres deep. Sides of shallow valleys meet the land
/// before they are steep.
double steepest_side(double ruggedness, double deep);

/// Returns the side of a valley below land of the height `land`. It rises from the water, more steeply beyond the
/// flood plain, and meets the land within valley_reach. Beside the water it is never below the water, if the land is
/// not.
inline ValleySide valley_side(double land, double ruggedness, const WatersidePoint& waterside) {
  const double away = waterside.distance;
  if (away >= valley_reach) return {land, 1, 0};
  const double slope = valley::slope_of_side(ruggedness);
  const double beyond = std::max(0.0, away - (40 + 8 * waterside.half_width));
  const double side = valley::plain_side(waterside, slope);
  const double blend = valley::blend_at(std::max(0.0, away - waterside.half_width));
  const double overlap = std::max(0.0, blend - std::abs(land - side));
  const double low = std::min(land, side) - overlap * overlap / (4 * blend);
  const Slope back =
      smooth_step(Slope{away * (1 / valley_reach), 1 / valley_reach, 0}, valley::first_return, 1);
  const double own = std::clamp((side - land) / (2 * valley::slope_blend) + 0.5, 0.0, 1.0);
  return {low + back.value * (land - low), 1 - (1 - own) * (1 - back.value),
          (0.02 + slope * smooth_step(beyond, 0, valley::steep_from)) * (1 - back.value) +
              back.east * (land - low)};
}

}  // namespace seedmesh::world
