#pragma once
/// Packs finished meshes before the rest of their model exists, so that a large mesh takes little memory
/// meanwhile.
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Packs the meshes of a model or of a part of one: quantizes them and encodes all arrays that will have a
/// view of their own. The bytes are those that write() with Dialect::compressed produces. Meshes that are not
/// triangles, and meshes whose material will still get textures (and so tangents), stay as they are.
///
/// The caller has called finish_meshes() and does not read the arrays again. The nodes already show the
/// meshes with the levels that the file will have, and no other mesh will share their grids.
void pack(Model& model, Job& job);

}  // namespace seedmesh::gltf
