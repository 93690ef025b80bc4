#pragma once
/// The first shape of a request: its lot.
#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

using Rings = std::vector<std::vector<std::array<double, 2>>>;

/// Faults of a footprint, with pointers below /footprint: rings without an area, that cross themselves or
/// each other, holes outside. Cost: the square of its points, at most 5,000 of which are taken.
std::vector<Issue> check_footprint(const Rings& rings);

/// The flat solid of a sound footprint, in its own unit square, and where that lies.
Solid footprint_of(const Rings& rings, glm::dvec3& origin, glm::dvec3& size);

}  // namespace seedmesh::building
