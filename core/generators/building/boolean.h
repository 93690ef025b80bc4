#pragma once
/// Union, difference and intersection of closed solids, by BSP trees (Thibault and Naylor, "Set operations on
/// polyhedra using binary space partitioning trees", 1987). The project has no library for this: Manifold is not
/// in Debian 12, and the corefinement of CGAL is under the GPL.
#include "core/base/job.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

enum class BooleanKind : std::uint8_t { unite, subtract, intersect };

/// Returns the result of a Boolean operation. Both solids are in metres and closed, and their normals point
/// outwards. The result is closed: faces of one plane are joined again, and meet edge to edge. Coplanar faces of
/// both count once. Faces keep their tags. Cost: about n log n for n faces in practice, at most n * n; checks the
/// deadline. `is_closed` of the result says whether every edge has two faces.
Solid boolean(const Solid& a, const Solid& b, BooleanKind kind, const Job& job);

}  // namespace seedmesh::building
