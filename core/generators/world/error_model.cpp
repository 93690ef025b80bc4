#include "core/generators/world/error_model.h"

#include <algorithm>

namespace seedmesh::world {
namespace {

constexpr double ridge_side = 8192;  ///< metres; from here, samples are too far apart for valleys and ridges
constexpr double valley_side =
    2048;  ///< metres; from here, samples are too far apart for the flats of valleys
constexpr double border_share = 0.45;  ///< the greatest deviation along a line, by that of the whole tile

}  // namespace

double error_of(const World& world, double side, const Roughness& roughness) {
  const WorldRelief& relief = world.params.relief;
  const double mountains = relief.mountains / 1000 * roughness.ruggedness, hills = relief.hills / 100;
  const bool is_coarse = side >= ridge_side;
  const double detail = 0.0012 * std::min(1.0, relief.mountains / 900) * roughness.ruggedness;
  const double terraces = relief.terraces * (0.001 * hills + 0.002 * mountains);
  double share = 0.0005 + 0.0007 * hills + (is_coarse ? 0.0068 : 0.0036) * mountains + detail + terraces;
  if (roughness.is_near_water) share += is_coarse ? 0.0055 : side >= valley_side ? 0.0045 : 0.0018;
  const double most = 2.2 * relief.mountains + 2 * relief.hills + 500, rise = share * side;
  return rise / (1 + rise / (1.2 * most));
}

double skirt_depth(const World& world, double side) {
  return border_share * error_of(world, 8 * side, {1, true}) + 0.25;
}

}  // namespace seedmesh::world
