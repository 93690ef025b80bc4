#pragma once
/// Roots: limbs that leave the trunk near the ground, come down beside it, and run along the ground with
/// bends and forks to tips below it. They have random numbers of their own and are written last, so that they
/// do not change the tree.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Writes the roots. Joint 0 is the foot at the origin with its flare. `trunk` is the radius of the trunk without
/// flare.
void grow_roots(const TreeRoots& roots, double trunk, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
