#pragma once
/// Corners of outlines that are moved inwards by a distance for each edge.
#include <vector>

#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

/// A node of an outline: the unit directions of the edges before and after it, and the distances by which these
/// move to their left, in centimetres.
struct CornerInput {
  glm::dvec2 at{0}, before{0}, after{0};
  double distance_before = 0, distance_after = 0;
  bool is_dead_end = false;
  double fillet = 0;   ///< greatest radius of the arc in a convex corner
  double chamfer = 0;  ///< width of the cut across a convex corner
  double cap = 0;      ///< how far the outline passes the tip of a dead end
  /// Where one of the streets is so much wider that its outline would pass the node: a step between the widths, this
  /// far from the node towards the narrower street. Not positive: the outlines end where they meet.
  double step = 0;
  double walk =
      0;  ///< of the border of a block: how far its step is from that of the kerb, towards the narrower street
};

/// Returns the greatest radius of an arc, in centimetres, that stays on the street's side of the block's corner,
/// behind a sidewalk of this width.
double fillet_of(const CornerInput& corner, double walk);

/// Returns the points of the corner, in the order of the outline; at least one. Arcs have an odd number.
std::vector<CmPoint> corner_points(const CornerInput& corner);

}  // namespace seedmesh::city
