#pragma once
/// Shares of the classes of ground by palette, height and slope.
#include "core/generators/terrain/colors.h"

namespace seedmesh::terrain {

/// Shares that sum to 1.
struct GroundShares {
  enum Kind { grass, soil, rock, scree, sand, snow, kind_count };
  float of[kind_count] = {};
};

/// Returns the shares at a site.
GroundShares ground_shares(PaletteName palette, const GroundColors& colors, const Site& site);

}  // namespace seedmesh::terrain
