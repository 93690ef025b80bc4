#pragma once
/// Separate vertices for corners whose normals point to the inner side of their faces.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// If the normal of a corner points to the inner side of its triangle, the corner gets a vertex of its own. This
/// vertex has the same position, and the normal of the face. Such corners arise at sharp bends of tubes with few
/// sides. Triangles are counter-clockwise seen from outside; indices have 32 bits (Mesh::index.wide). Cost: a few
/// nanoseconds for each triangle.
void split_inward_corners(Mesh& mesh, const Job& job);

}  // namespace seedmesh
