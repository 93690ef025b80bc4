#pragma once
/// Joining of equal vertices.
#include "core/model/mesh.h"

namespace seedmesh {

/// Joins vertices that are equal in every attribute, bit by bit, with -0 equal to 0. The first of equal
/// vertices stays, in the same order; triangles keep their order. Linear time, by hashing.
void weld(Mesh& mesh, Job& job);

}  // namespace seedmesh
