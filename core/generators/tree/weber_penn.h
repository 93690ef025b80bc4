#pragma once
/// The model of Weber and Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH 1995: stems that bend,
/// split, taper and bear shorter stems, down to the leaves. The foot is at the origin; metres, +Y up.
///
/// Where the paper is silent: errors of splitting are carried along one stem, not over a whole level, so that
/// a choice in one place moves nothing elsewhere; a stem and its clones share the children of the stem; a
/// helix takes one turn for six pieces; the height is at least a tenth of Scale. Linear in what it writes.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

void grow_weber_penn(const TreeParams& params, const Chances& chances, SkeletonWriter& writer);

}  // namespace seedmesh::tree
