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

/// The rotation of one segment.
struct SwayAngles {
  double x = 0, y = 0;  ///< degrees about the left axis and the up axis of the frame
};

/// Returns the degrees by which a segment turns about its left and up axes. It starts at fraction `z` of the stem,
/// where the radius is `radius`. Each angle is (a1 sin(b) + a2 sin(0.7 b)) / segments, with:
/// - a0 = 4 * length * (1 - z) / radius;
/// - a1 = a0 * wind / 50, and a2 = a0 * gust / 50 + a1 / 2;
/// - b = offset + base_radius / length * time / 15, with offset_x or offset_y.
/// Unlike in the paper, a whole stem turns by at most 90 degrees.
SwayAngles sway_angles(const TreeSway& sway, const SwayingStem& stem, double z, double radius);

/// Returns the frame of a segment turned by these angles.
Frame swayed(const Frame& frame, const SwayAngles& angles);

}  // namespace seedmesh::tree
