#pragma once
/// Rings of maps as plans without errors. Real outlines repeat points, have points on straight edges, spikes, and touch
/// themselves.
#include <vector>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

struct SoundPlans {
  std::vector<Plan> plans;     ///< none if the outer ring has no area or cannot be divided
  std::size_t lost_holes = 0;  ///< holes that cross other rings
  bool is_divided = false;     ///< the outer ring crosses itself and is divided where it does
  bool has_crossing = false;   ///< a part of the outer ring crosses itself and is left out
};

/// Plans of an outer ring and holes in metres, in any direction. Points are rounded to millimetres; those that repeat
/// another, lie on a straight edge (to 2 mm) or end a spike are left out; an
/// outer ring that touches or crosses itself is divided there, and what it encloses an even number of times is outside
/// (twice in one direction: inside); holes that touch another ring become smaller by a centimetre. Cost: that of `faults_of`.
/// Checks stop and deadline where there is a job.
SoundPlans sound_plans(const std::vector<PlanRing>& rings, const Job* job = nullptr);

}  // namespace seedmesh
