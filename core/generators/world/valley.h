#pragma once
/// The surface of a valley beside its water, which the ground and the profiles of rivers share.
#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Metres. Water that is farther away does not change the ground.
constexpr double valley_reach = 1400;

/// Returns the side of a valley at a distance from its water, above the water, and about its slope: at
/// the foot, the slope rises over some metres. Infinite at the reach, so
/// that water beyond it never counts; also where it is not below `most`.
Slope valley_side(double away, double half_width, double ruggedness, double most);

/// Returns the metres of height over which a valley meets the land, at a distance from a bank. Beside the water it is
/// small, so that the rounding never cuts the bank below the water.
double valley_blend(double from_bank);

}  // namespace seedmesh::world
