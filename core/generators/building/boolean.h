#pragma once
/// Union, difference and intersection of closed solids, by BSP trees (Thibault and Naylor, "Set operations on
/// polyhedra using binary space partitioning trees", 1987). The project uses no library for this, because Manifold is
/// not in Debian 12, and the corefinement of CGAL is under the GPL.
#include "core/base/job.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

enum class BooleanKind : std::uint8_t { unite, subtract, intersect };

/// Returns the result of a Boolean operation. Both solids are in metres and closed, and their normals point outwards.
/// Faces of the result that lie in one plane are joined again, and faces meet edge to edge. Coplanar faces of both
/// solids count once. Faces keep their tags. The result should be closed; its member `is_closed` states whether every
/// edge has two faces. Cost: about n log n for n faces in practice, at most n * n. Checks the deadline.
Solid boolean(const Solid& a, const Solid& b, BooleanKind kind, const Job& job);

}  // namespace seedmesh::building
