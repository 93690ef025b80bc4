#pragma once
/// A stem in the wind at one moment: Weber and Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH
/// 1995, section 4.8. Only the curvature of stems changes, not their length.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// The properties of a stem that matter for its sway.
struct SwayingStem {
  double length = 0, base_radius = 0;
  int segments = 1;
  double offset_x = 0, offset_y = 0;  ///< radians, random
};

/// Degrees by which the segment that begins at share `z` of the stem, where its radius is `radius`, turns
/// about its two axes. With a0 = 4 length (1 - z) / radius, a1 = a0 wind / 50, a2 = a0 gust / 50 + a1 / 2 and
/// b = offset + base_radius / length time / 15 these are (a1 sin b + a2 sin 0.7 b) / segments. Other than in
/// the paper, no stem turns by more than 90 degrees in all.
struct SwayAngles {
  double x = 0, y = 0;
};
SwayAngles sway_angles(const TreeSway& sway, const SwayingStem& stem, double z, double radius);

/// The frame of a segment turned by these angles.
Frame swayed(const Frame& frame, const SwayAngles& angles);

}  // namespace seedmesh::tree
