#pragma once
/// Sheets: meshes of leaves, fruits and patches while they are made, with positions, normals, texture
/// coordinates and wide indices.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

Mesh empty_sheet(const Job& job);

/// Where a face is bent so far that the normal of a corner looks to its other side, the normal gives way.
void settle_normals(Mesh& mesh);

/// Takes out triangles of no area, vertices that no triangle names, and those that are the same as another.
void drop_unused(Mesh& mesh, const Job& job);

}  // namespace seedmesh
