#pragma once
/// Rings that cross themselves.
#include "core/geom/polygon/plan.h"

namespace seedmesh {

/// A ring with a point, rounded to millimetres, on both edges wherever two of its edges cross, and on an edge wherever
/// another of its points lies on it. Cost: the square of the number of points. Checks stop and deadline where there is a
/// job.
PlanRing with_crossings(const PlanRing& ring, const Job* job = nullptr);

}  // namespace seedmesh
