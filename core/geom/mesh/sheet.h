#pragma once
/// Helpers for sheets: meshes of leaves, fruits and patches under construction, with positions, normals,
/// texture coordinates and wide indices.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Returns a mesh with these four arrays, all empty.
Mesh empty_sheet(const Job& job);

/// Rotates vertex normals so that none faces away from a face of its vertex.
void settle_normals(Mesh& mesh);

/// Removes triangles without area, unused vertices and duplicates of vertices.
void drop_unused(Mesh& mesh, const Job& job);

}  // namespace seedmesh
