#pragma once
/// The weighted straight skeleton of a plan: every edge moves inwards at its own speed, corners stay mitred,
/// and the trace of the corners cuts the plan into one face for each edge.
///
/// Aichholzer, Aurenhammer, Alberts and Gaertner, "A novel type of skeleton for polygons", 1995; weights as
/// in Biedl et al., "Weighted straight skeletons in the plane", 2015. Events that fall on one time and place
/// are resolved together, by sorting what leaves the place round it, as in Kelly and Wonka, "Interactive
/// architectural modeling with procedural extrusions", 2011.
#include <limits>

#include "core/geom/plan.h"

namespace seedmesh {

/// What an edge has passed over, or, for an edge of speed 0, the upright wall over it, which has no area in
/// plan.
struct SkeletonFace {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::uint32_t edge = 0;
  /// Between two edges of one line whose speeds differ: an upright step that belongs to the faster one.
  bool is_step = false;
  std::vector<std::uint32_t> outline;             ///< nodes, counter-clockwise; the edge itself first
  std::vector<std::vector<std::uint32_t>> holes;  ///< nodes, clockwise; rare
};

/// A closed line at the end time: what is left of the plan lies to its left.
struct SkeletonFront {
  std::vector<std::uint32_t> node;  ///< of its points
  std::vector<std::uint32_t> edge;  ///< edge[i], the one that moved, goes from point i to the next
};

struct StraightSkeleton {
  std::vector<glm::dvec3> node;  ///< x, y in plan and the time, in z; first the points of the plan, in order
  std::vector<SkeletonFace> faces;    ///< by edge, rising; an edge may have several
  std::vector<SkeletonFront> fronts;  ///< at the end time; empty where everything has met before
  /// True when every face passed the check: a simple outline, turned rightly, in the plane of its edge; and
  /// the areas of all faces and of what is left add up to the plan. Where false the rest is of no use.
  bool is_sound = false;
};

struct SkeletonOptions {
  /// Of each edge, metres in a unit of time, >= 0; empty: all 1. An edge of speed 0 stands still.
  std::span<const double> speed = {};
  double end_time = std::numeric_limits<double>::infinity();
};

/// Rings without faults (plan.h; others give nothing sound), but they need not be nested: the inside is to
/// the left of each. So a single clockwise ring grows outwards; then the end time must be finite. About n log
/// n steps that look at n edges each. Looks at the job's stop and
/// deadline.
StraightSkeleton straight_skeleton(const Plan& plan, const SkeletonOptions& options, const Job& job);

}  // namespace seedmesh
