#include "core/generators/tree/sway.h"

#include <algorithm>

#include "core/base/quick_math.h"

namespace seedmesh::tree {
namespace {

constexpr double most_sway = 90;  ///< degrees, of a whole stem
constexpr double thinnest = 1e-4;

double angle(double a1, double a2, double b, int segments) {
  const double sway = a1 * math::quick_sincos(b).sin + a2 * math::quick_sincos(0.7 * b).sin;
  return std::clamp(sway, -most_sway, most_sway) / segments;
}

}  // namespace

SwayAngles sway_angles(const TreeSway& sway, const SwayingStem& stem, double z, double radius) {
  const double a0 = 4 * stem.length * (1 - z) / std::max(radius, thinnest);
  const double a1 = a0 * sway.wind / 50, a2 = a0 * sway.gust / 50 + a1 / 2;
  const double passed = stem.base_radius / std::max(stem.length, thinnest) * sway.time / 15;
  return {angle(a1, a2, stem.offset_x + passed, stem.segments),
          angle(a1, a2, stem.offset_y + passed, stem.segments)};
}

Frame swayed(const Frame& frame, const SwayAngles& angles) {
  return turn(pitch(frame, math::quick_sincos_degrees(angles.x)), math::quick_sincos_degrees(angles.y));
}

}  // namespace seedmesh::tree
