#pragma once
/// Collision shapes of buildings: convex bodies around their masses.
#include "core/generators/api.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"

namespace seedmesh::building {

/// Adds nodes with convex meshes below the root if context.demand.collision requests them. A mass is a closed
/// body that the rules split into faces or draw as a whole. Windows and roofs, for example, are bodies on a face of
/// another body. They are masses only if their box has at least a twentieth of the volume of the largest mass.
///
/// A mass inside the hull of another is left out. A mass that fills less than 92 % of its hull is cut in two across
/// an axis. This is done only if it reduces the volume of the hulls by at least 4 %. There are at most 32 bodies, the
/// largest first, and none with less than a thousandth of the largest volume.
void add_collision(Model& model, const Shapes& shapes, const GenerateContext& context);

}  // namespace seedmesh::building
