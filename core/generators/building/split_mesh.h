#pragma once
/// Splits a mesh, for levels of detail that need as many meshes as the finest level.
#include "core/model/model.h"

namespace seedmesh::building {

/// Moves the second half of the triangles of the largest primitive to a new mesh, with the vertices that they
/// need. Returns nullopt if every primitive has fewer than four triangles. The two triangles of a rectangle
/// stay together.
std::optional<MeshGroup> split_in_half(MeshGroup& group, const Job& job);

}  // namespace seedmesh::building
