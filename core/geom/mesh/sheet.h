#pragma once
/// Helpers for sheets: meshes of leaves, fruits and patches under construction, with positions, normals,
/// texture coordinates and wide indices.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Returns a mesh with these four arrays, all empty.
Mesh empty_sheet(const Job& job);

/// Turns normals of corners that point to the back of one of their faces to its front.
void settle_normals(Mesh& mesh);

/// Removes triangles without area, unused vertices and duplicates of vertices.
void drop_unused(Mesh& mesh, const Job& job);

}  // namespace seedmesh
