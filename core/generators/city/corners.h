#pragma once
/// Computes the corners of an outline whose edges move inwards, each by a distance of its own.
#include <vector>

#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

/// A node of an outline. `before` and `after` are the unit directions of the edges before and after it. Each edge
/// moves to its left by its distance. All lengths are centimetres.
struct CornerInput {
  glm::dvec2 at{0}, before{0}, after{0};
  double distance_before = 0, distance_after = 0;
  bool is_dead_end = false;
  double fillet = 0;   ///< greatest radius of the arc in a convex corner
  double chamfer = 0;  ///< width of the cut across a convex corner
  double cap = 0;      ///< distance by which the outline passes the tip of a dead end
  /// Distance from the node to a step between the widths, along the narrower street. The step is needed where the
  /// outline of a much wider street would pass the node. If `step` is not positive, the outlines end where they meet.
  double step = 0;
  /// For the border of a block: distance from the step of the kerb to that of the border, along the narrower street.
  double walk = 0;
};

/// Returns the greatest radius of a kerb's arc, in centimetres, with which the arc stays on the street's side of the
/// block's corner. `walk` is the width of the sidewalk between them, in centimetres.
double fillet_of(const CornerInput& corner, double walk);

/// Returns the points of the corner, in the order of the outline; at least one. An arc has an odd number of points.
std::vector<CmPoint> corner_points(const CornerInput& corner);

}  // namespace seedmesh::city
