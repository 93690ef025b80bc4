#pragma once
/// Collision shapes of buildings: convex bodies around their masses.
#include "core/generators/api.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"

namespace seedmesh::building {

/// Adds nodes with convex meshes below the root, if context.demand.collision asks for them. A mass is a closed
/// body that the rules take apart into faces or draw as a whole. Bodies on the faces of others, such as
/// windows and roofs, count from a twentieth of the largest volume. A mass inside the hull of another is left
/// out. A mass far from convex is cut in two across an axis while that makes its hulls smaller. There are at
/// most 32 bodies, the largest first, and none below a thousandth of the largest.
void add_collision(Model& model, const Shapes& shapes, const GenerateContext& context);

}  // namespace seedmesh::building
