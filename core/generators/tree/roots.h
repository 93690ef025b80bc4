#pragma once
/// Roots: limbs from the foot of a trunk outward and down. They have a stream of chance of their own and are
/// written last, so that they change nothing of the tree.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// `foot` is the joint at the origin, of the trunk's radius.
void grow_roots(const TreeRoots& roots, const Chances& chances, std::uint32_t foot, SkeletonWriter& writer);

}  // namespace seedmesh::tree
