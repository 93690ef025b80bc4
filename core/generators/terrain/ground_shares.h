#pragma once
/// Shares of the classes of ground by palette, height and slope.
#include "core/generators/terrain/colors.h"

namespace seedmesh::terrain {

/// Shares that sum to 1.
struct GroundShares {
  enum Kind { grass, soil, rock, scree, sand, snow, kind_count };
  float of[kind_count] = {};
};

inline GroundShares blend(const GroundShares& a, const GroundShares& b, float t) {
  GroundShares all;
  for (int k = 0; k < GroundShares::kind_count; ++k) all.of[k] = a.of[k] + t * (b.of[k] - a.of[k]);
  return all;
}

/// Returns the bilinear interpolation of the values at(0, 0) to at(1, 1) at the four samples of a square, by
/// blend() of two values.
template <class At>
auto bilinear(const At& at, float u, float v) {
  return blend(blend(at(0, 0), at(1, 0), u), blend(at(0, 1), at(1, 1), u), v);
}

/// Returns the shares at a site.
GroundShares ground_shares(const GroundColors& colors, const Site& site);

}  // namespace seedmesh::terrain
