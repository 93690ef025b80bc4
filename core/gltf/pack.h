#pragma once
/// Meshes made ready for a compressed file before the rest of their model is there, so that a great one waits
/// in memory as small as the file will have it.
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Packs the meshes of a model, or of a part that is to become one: quantizes them and encodes all arrays
/// that get a view of their own, as write() with Dialect::compressed would do it, to the same bytes. Left as
/// they are: what is not triangles, and meshes whose material is still to get textures and with them
/// tangents.
///
/// Promises of the caller: the meshes went through finish_meshes(); nobody looks at their arrays again; the
/// nodes show them with the levels that they will have in the file, and nothing else will share their grids.
void pack(Model& model, Job& job);

}  // namespace seedmesh::gltf
