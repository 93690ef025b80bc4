#pragma once
/// Does a mesh stay a surface for a reader who welds its vertices?
#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// True where, with vertices joined that are nearer than `reach`, an edge has more than two triangles or two
/// that disagree about the outside: as in heaps of limbs thinner than that. 60 ns a triangle: for meshes
/// that give reason to doubt.
bool is_crowded(const Mesh& mesh, float reach, const Job& job);

}  // namespace seedmesh
