#pragma once
/// The model of J. Weber and J. Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH 1995: stems that
/// bend, split, taper and bear shorter stems, down to the leaves. The foot is at the origin; metres, +Y up.
///
/// The paper does not specify the following. The rounding error of the number of splits is accumulated along
/// one stem, not across a level. A choice for one stem therefore does not change others. If a stem
/// splits, its additional stems (clones) share its children with it. A helix makes one turn in six pieces. The height
/// is at least a tenth of Scale. Cost: linear in the size of the skeleton.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Writes the skeleton of a tree of the model `weber_penn`.
void grow_weber_penn(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
