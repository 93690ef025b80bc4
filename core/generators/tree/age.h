#pragma once
/// A tree before it is full-grown: the same skeleton, of which a part is there and each limb has a part of
/// its size.
///
/// The trunk has at the time t (0..1) the size 1 - (1 - t)^2. A limb sprouts at b, after its parent: sooner
/// where it is thick or near its parent's foot, otherwise by chance, in the first half of what is left to its
/// parent. Beside its parent it then has the size 1 - (1 - x)^2 of what it will have, x being the share of
/// its parent's time that it has lived, (t - b) / (t (1 - b)): so a young tree is a small tree of few limbs,
/// not a bare stem. All of it is continuous in t, so that no limb jumps; a limb is thinner than long in its
/// youth (radii go by the 1.5th power of lengths: T. McMahon, "Size and shape in biology", Science 179,
/// 1973). Leaves unfold with the twig that bears them and are of full size from 0.4 on, before by the 3/4th
/// power of the trunk's size. A seedling, younger than 0.1, has first leaves on its stems where limbs will
/// sprout.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// When the internode of each joint sprouts in the growth animation, 0..1: from the foot of each limb to its
/// tip, at the latest when 0.8 of the time have passed.
Array<float> births_of(const Limbs& limbs, Job& job);

/// Leaves of the skeleton what is there at the time `share`, 0..1. Linear.
void make_young(Skeleton& skeleton, double share, Job& job);

}  // namespace seedmesh::tree
