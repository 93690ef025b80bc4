#pragma once
/// A mesh in two, for levels of detail that need as many meshes as the finest has.
#include "core/model/model.h"

namespace seedmesh::building {

/// Takes the later half of the largest primitive away, as a mesh of its own with the vertices it needs; none
/// where no primitive has four triangles. Pairs of triangles stay together.
std::optional<MeshGroup> halve(MeshGroup& group, const Job& job);

}  // namespace seedmesh::building
