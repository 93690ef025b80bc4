#pragma once
/// The planner: which side limbs of a limb are welded to it, and where.
#include "core/geom/plant/graft/graft_input.h"
#include "core/geom/plant/graft/ring_plan.h"

namespace seedmesh {

/// Reads what a junction needs to know of a side limb; at most a length of 16 radii. Its `length` is 0 where
/// it has no piece that can be seen. Sides and angles are the caller's.
ChildLimb read_child(const GraftInput& in, std::uint32_t limb);

/// Adds junctions to a plan, which begin_plan() has begun, for the side limbs of `axis` that may be welded
/// and are thick enough. Thick limbs come first: a fork has one possible position, thin limbs have many.
void plan_junctions(const GraftInput& in, const LimbAxis& axis, LoopAngles& angles, RingPlan& plan);

}  // namespace seedmesh
