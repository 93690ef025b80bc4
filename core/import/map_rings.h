#pragma once
/// Rings of maps as plans without errors. Real outlines repeat points, have points on straight edges, spikes, and touch
/// themselves.
#include <vector>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

struct SoundPlans {
  std::vector<Plan> plans;     ///< none if the outer ring crosses itself or has no area
  std::size_t lost_holes = 0;  ///< holes that cross other rings
  bool has_crossing = false;   ///< the outer ring crosses itself
};

/// Plans of an outer ring and holes in metres, in any direction. Points are rounded to millimetres; those that repeat
/// another, lie on a straight edge (to 2 mm) or end a spike are left out; a ring that touches itself in a point is
/// divided there; holes that touch another ring become smaller by a centimetre. Cost: that of `faults_of`.
/// Checks stop and deadline where there is a job.
SoundPlans sound_plans(const std::vector<PlanRing>& rings, const Job* job = nullptr);

}  // namespace seedmesh
