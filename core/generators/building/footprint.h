#pragma once
/// The footprint of a request, on which the first shape stands.
#include <array>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

using Rings = std::vector<std::vector<std::array<double, 2>>>;

/// Returns the errors of a footprint, with pointers below /footprint: rings without an area, rings that cross
/// themselves or each other, and holes that lie outside. More than 5,000 points exceed a limit. Cost: about n log n
/// in practice. Checks cancellation and deadline if there is a job.
std::vector<Issue> check_footprint(const Rings& rings, const Job* job = nullptr);

/// Returns a valid footprint as a flat solid in its unit square; `origin` and `size` become the
/// position and the extent of that square, in metres.
Solid footprint_of(const Rings& rings, glm::dvec3& origin, glm::dvec3& size);

}  // namespace seedmesh::building
