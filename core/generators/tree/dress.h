#pragma once
/// A tree's skeleton -> Model: bark and leaves, two materials.
#include "core/generators/tree/growth_context.h"
#include "core/geom/graft.h"
#include "core/model/model.h"

namespace seedmesh::tree {

Model dress(Skeleton skeleton, const TreeParams& params, Job& job);

/// How the bark of the finest level is made.
GraftOptions bark_options(const TreeParams& params);

/// Corners of the cross-section of the trunk.
int sides_of(const TreeParams& params);

}  // namespace seedmesh::tree
