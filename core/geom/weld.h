#pragma once
#include "core/model/mesh.h"

namespace seedmesh {

/// Makes one vertex of all that are equal in every attribute, bit by bit (but -0 is 0). The first of equals
/// stays where it was among the others; triangles keep their order. Linear, by hashing (meshoptimizer).
void weld(Mesh& mesh, Job& job);

}  // namespace seedmesh
