#pragma once
/// A tree before it is full-grown: a part of its skeleton, with smaller limbs.
///
/// Let t be the time, 0 .. 1. The trunk has the relative size 1 - (1 - t)^2. A limb sprouts at a time b in
/// the first half of the time that remains when its parent sprouts. Thick limbs and limbs near the base of
/// their parent sprout earlier; apart from that, b is random. Let x = (t - b) / (t (1 - b)), the share of the
/// parent's life. Relative to its parent, the limb then has the size 1 - (1 - x)^2. So a young tree is a
/// small tree with few limbs, not a bare stem. Everything is continuous in t. Radii change with the 1.5th
/// power of lengths (T. McMahon, "Size and shape in biology", Science 179, 1973). Leaves unfold with their
/// twig. Before t = 0.4 their size is the 3/4th power of that of the trunk. Before t = 0.1, stems have first
/// leaves where limbs will sprout.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Returns the time at which the internode of each joint sprouts in the growth animation, 0 .. 0.8, from the
/// base of each limb to its tip.
Array<float> births_of(const Limbs& limbs, Job& job);

/// Reduces the skeleton to the time `share`, 0 .. 1. Linear in its size.
void make_young(Skeleton& skeleton, double share, Job& job);

}  // namespace seedmesh::tree
