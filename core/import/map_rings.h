#pragma once
/// Converts outlines of maps to plans without defects (see defects_of()). Real outlines repeat points, have
/// spikes and points on straight edges, and touch themselves.
#include <vector>

#include "core/geom/polygon/plan.h"

namespace seedmesh {

struct ValidPlans {
  std::vector<Plan> plans;     ///< none if the outer ring has no area or cannot be divided
  std::size_t lost_holes = 0;  ///< holes left out because of a defect or their size
  bool is_divided = false;     ///< the outer ring crosses itself and is divided where it does
  bool has_crossing = false;   ///< a part of the outer ring crosses itself and is left out
};

/// Returns plans without defects for an outer ring and holes in metres. The rings may run in either direction. Points
/// are rounded to millimetres. Points that repeat another point, lie on a straight edge (within 2 mm) or are
/// the tip of a spike are left out. An outer ring that touches or crosses itself is divided there, by the
/// nonzero winding rule. Holes that touch another ring become smaller by a centimetre. Cost: that of
/// defects_of(). Checks stop and deadline if `job` is not null.
ValidPlans valid_plans(const std::vector<PlanRing>& rings, const Job* job = nullptr);

/// Joins lines end to end to rings, without repeated first points. Adds the number of the lines that are left to `open`.
std::vector<std::vector<glm::dvec2>> joined_rings(std::vector<std::vector<glm::dvec2>> lines,
                                                  std::size_t& open);

}  // namespace seedmesh
