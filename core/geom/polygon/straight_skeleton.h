#pragma once
/// The weighted straight skeleton of a plan. Every edge moves inwards at its own speed with mitred corners.
/// The traces of the corners divide the plan into faces, each of which belongs to one edge.
///
/// Aichholzer, Aurenhammer, Alberts and Gaertner, "A novel type of skeleton for polygons", 1995; weights as in
/// Biedl et al., "Weighted straight skeletons in the plane", 2015. Events with equal time and position are
/// resolved together: the edges that leave the position are sorted by their direction, as in Kelly and Wonka,
/// "Interactive architectural modeling with procedural extrusions", 2011.
#include <limits>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

/// The region that an edge has passed over. An edge of speed 0 has a vertical wall without an area in plan.
struct SkeletonFace {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::uint32_t edge = 0;
  /// A vertical step between two collinear edges of different speeds; it belongs to the faster edge.
  bool is_step = false;
  std::vector<std::uint32_t> outline;             ///< nodes, counter-clockwise; the edge itself first
  std::vector<std::vector<std::uint32_t>> holes;  ///< nodes, clockwise; rare
};

/// A closed outline at the end time, counter-clockwise around the rest of the plan.
struct SkeletonFront {
  std::vector<std::uint32_t> node;  ///< nodes of its points
  std::vector<std::uint32_t> edge;  ///< edge[i] goes from point i to the next
};

struct StraightSkeleton {
  std::vector<glm::dvec3> node;       ///< x and y in plan, z is the time; first the points of the plan
  std::vector<SkeletonFace> faces;    ///< faces, sorted by edge; an edge may have several
  std::vector<SkeletonFront> fronts;  ///< fronts at the end time; empty if nothing is left
  /// Whether the result passed its check. Every face must have a simple, counter-clockwise outline in the plane of
  /// its edge. The areas of faces and fronts must sum to the area of the plan. If false, do not use the result.
  bool is_sound = false;
};

struct SkeletonOptions {
  /// The speed of each edge, >= 0; empty: all 1. An edge of speed 0 does not move.
  std::span<const double> speed = {};
  double end_time = std::numeric_limits<double>::infinity();
};

/// Returns the skeleton of rings without defects (plan.h; with defects the result is not valid). Rings need not be
/// nested: the inside is to the left of each, so that a single clockwise ring grows outwards, which needs a
/// finite end time. Cost: about n log n steps over n edges each. Checks the deadline of the job.
StraightSkeleton straight_skeleton(const Plan& plan, const SkeletonOptions& options, const Job& job);

}  // namespace seedmesh
