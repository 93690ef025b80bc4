#pragma once
/// Convex bodies round the trunk and the thick limbs, for physics.
#include "core/base/job.h"
#include "core/geom/limbs.h"
#include "core/model/model.h"

namespace seedmesh::tree {

/// Adds a node and a mesh for each body: a straight piece of limb as a prism of eight sides, closed. Names
/// are what job.demand().collision says. Limbs from a third of the trunk's radius on have bodies, at most 32.
void add_collision(Model& model, const Limbs& limbs, Job& job);

}  // namespace seedmesh::tree
