#pragma once
/// Check of a mesh for edges that are not manifold after welding.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Joins vertices that are nearer than `radius`, as importers may do. Returns true if an edge then has more than two
/// triangles, or two whose orientations disagree. Overlapping clusters of limbs thinner than the radius give such
/// edges. Cost: 60 ns for each triangle, so call it only where neighbours are suspected.
bool has_nonmanifold_edges(const Mesh& mesh, float radius, const Job& job);

}  // namespace seedmesh
