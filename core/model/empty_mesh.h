#pragma once
/// The start of every mesh that a request builds.
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Returns a mesh whose positions, normals and wide indices are empty and charged to the job.
Mesh empty_mesh(const Job& job);

}  // namespace seedmesh
