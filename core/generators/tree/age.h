#pragma once
/// A tree before it is full-grown: the same skeleton, of which a part is there and each limb has a part of
/// its size.
///
/// The trunk sprouts at 0; a limb sprouts after its parent, the earlier the nearer it stands to its parent's
/// foot, at the latest when 0.8 of the time to maturity have passed. A limb that sprouts at b has at the time
/// t (0..1) the size 1 - (1 - x)^2, x = (t - b) / (1 - b), of its own, and is as much smaller as its parent
/// is. All of it is continuous in t, so that no limb jumps; a limb is thinner than long in its youth (radii
/// go by the 1.5th power of lengths: T. McMahon, "Size and shape in biology", Science 179, 1973). Leaves
/// unfold with the twig that bears them and are then of full size, whatever the age of the tree.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// When the internode of each joint sprouts, 0..1.
Array<float> births_of(const Limbs& limbs, Job& job);

/// Leaves of the skeleton what is there at the time `share`, 0..1. Linear.
void make_young(Skeleton& skeleton, double share, Job& job);

}  // namespace seedmesh::tree
