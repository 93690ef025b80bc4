#pragma once
/// Roots: limbs that leave the flank of a trunk thick, come down to the ground beside it and run out along
/// it, winding and forking, to tips below. They have a stream of chance of their own and are written last, so
/// that they change nothing of the tree.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// Joint 0 is the foot at the origin, as wide as the flare makes it; `trunk` is the trunk's radius without
/// it.
void grow_roots(const TreeRoots& roots, double trunk, const Chances& chances, SkeletonWriter& writer);

}  // namespace seedmesh::tree
