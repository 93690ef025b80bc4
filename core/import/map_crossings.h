#pragma once
/// Rings that cross themselves.
#include "core/geom/polygon/plan.h"

namespace seedmesh {

/// Returns the ring with further points, rounded to millimetres. Where two of its edges cross, both get a point.
/// Where one of its points lies on an edge, that edge gets a point. Cost: the square of the number of points.
/// Checks stop and deadline if `job` is not null.
PlanRing with_crossings(const PlanRing& ring, const Job* job = nullptr);

}  // namespace seedmesh
