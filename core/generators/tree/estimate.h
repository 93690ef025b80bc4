#pragma once
/// The size of a tree, estimated from its skeleton.
#include "core/generators/api.h"
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Trees with more than `most_appraised` joints have no estimate, nor do trees with more than most_appraised *
/// leaves_a_joint leaves. To grow 300,000 joints takes about 0.1 s.
constexpr std::size_t most_appraised = 300'000, leaves_a_joint = 5;

/// Estimates the finest level: leaves are counted, the bark is estimated, and textures have their average size.
/// `skeleton` is the one that generate() would pass to build_model().
Estimate estimate_of(Skeleton skeleton, const TreeParams& params, const GenerateContext& context);

}  // namespace seedmesh::tree
