#pragma once
/// Selects the side limbs that get a closed junction with their parent limb, and the positions of the junctions.
#include "core/geom/plant/graft/graft_input.h"
#include "core/geom/plant/graft/ring_plan.h"

namespace seedmesh {

/// Reads what a junction needs from the beginning of a side limb, until its length exceeds 16 radii. The `length` is 0
/// if no internode is longer than GraftInput::scale.shortest. The caller sets `sides` and `angles`.
ChildLimb read_child(const GraftInput& in, std::uint32_t limb);

/// Adds junctions to a plan, which begin_plan() has begun, for the side limbs of `axis` that are joined fully
/// (JoinMode::full) and are thick enough. Limbs thicker than half of their parent come first, because they fit at one
/// position only.
void plan_junctions(const GraftInput& in, const LimbAxis& axis, LoopAngles& angles, RingPlan& plan);

}  // namespace seedmesh
