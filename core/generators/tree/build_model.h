#pragma once
/// Makes the model of a tree from its skeleton: bark and leaves with their materials.
#include "core/generators/api.h"
#include "core/generators/tree/skeleton_writer.h"
#include "core/geom/plant/graft/graft.h"
#include "core/model/model.h"

namespace seedmesh::tree {

/// Makes the model, with the levels of detail and the animation that the context demands.
Model build_model(Skeleton skeleton, const TreeParams& params, const GenerateContext& context);

/// Options of the bark of the finest level of detail.
GraftOptions bark_options(const TreeParams& params);

/// Number of corners of the cross-section of the trunk.
int sides_of(const TreeParams& params);

}  // namespace seedmesh::tree
