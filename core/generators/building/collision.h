#pragma once
/// Collision shapes of buildings: convex bodies around their masses.
#include "core/generators/building/shapes.h"
#include "core/model/model.h"

namespace seedmesh::building {

/// Adds nodes below the root, where job.demand().collision wants them. A mass is a closed body that is taken
/// apart into faces, or drawn whole; what a face of another carries, as walls carry windows, counts from a
/// twentieth of the largest on, as roofs do. One that lies in the hull of another is left out. A mass that is
/// far from convex is cut in two across the axes of its scope as long as its hulls shrink by that. At most 32
/// bodies, the largest first; none below a thousandth of the largest.
void add_collision(Model& model, const Shapes& shapes, Job& job);

}  // namespace seedmesh::building
