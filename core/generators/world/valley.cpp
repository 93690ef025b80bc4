#include "core/generators/world/valley.h"

namespace seedmesh::world {

using valley::first_return, valley::steep_from, valley::slope_of_side, valley::most_blend, valley::plain_side;

double steepest_side(double ruggedness, double deep) {
  constexpr double steepest_return = 1.5 / (1 - first_return);
  const double slope = slope_of_side(ruggedness);
  return 0.02 + slope * smooth_step(deep / slope, 0, steep_from) + deep * steepest_return / valley_reach;
}

double lowest_side(const WatersidePoint& waterside) {
  return plain_side(waterside, slope_of_side(0)) - most_blend / 4;
}

}  // namespace seedmesh::world
