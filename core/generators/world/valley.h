#pragma once
/// The surface of a valley beside its water, which the ground and the profiles of rivers share.
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

/// Whether valley_side() is certainly not below `height`, which is at most `land`. Takes less time than valley_side().
bool is_above(double height, double land, double ruggedness, const WatersidePoint& waterside);

/// Returns a lower bound, in metres, of the sides of valleys in land that is higher than this bound.
double lowest_side(const WatersidePoint& waterside);

/// Returns the steepest slope of the sides of valleys that are `deep` metres deep. Sides of shallow valleys meet the land
/// before they are steep.
double steepest_side(double ruggedness, double deep);

/// Returns the side of a valley below land of the height `land`. It rises from the water, more steeply beyond the
/// flood plain, and meets the land within valley_reach. Beside the water it is never below the water, if the land is
/// not.
ValleySide valley_side(double land, double ruggedness, const WatersidePoint& waterside);

}  // namespace seedmesh::world
