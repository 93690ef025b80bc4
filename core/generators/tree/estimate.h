#pragma once
/// What a tree will cost, told by its skeleton before it is skinned.
#include "core/generators/appraisal.h"
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// A tree of more joints than this, or of so many times more leaves (drawn or not), is not grown for an
/// estimate: about a tenth of a second.
constexpr std::size_t most_appraised = 300'000, leaves_a_joint = 5;

/// Of the finest level; leaves are counted, bark is reckoned. `skeleton`: what generate() would dress.
/// Pictures count with what the usual ones take.
Estimate estimate_of(Skeleton skeleton, const TreeParams& params, Job& job);

}  // namespace seedmesh::tree
