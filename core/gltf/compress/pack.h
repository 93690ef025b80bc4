#pragma once
/// Compresses finished meshes before the rest of their model exists, so that a large mesh takes little memory
/// until the file is written.
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Compresses the meshes of a model or of a part of one: quantizes them and encodes all arrays that get their own
/// bufferView. The bytes are those that write() with Dialect::compressed produces. Meshes that are not
/// triangles, and meshes whose material will still get textures (and so tangents), stay as they are.
///
/// Preconditions: finish_meshes() has been called, and nothing reads the arrays afterwards. Nodes refer to their final
/// meshes and levels of detail. No later mesh uses the same grid, the origin and step to which positions are quantized.
void pack(Model& model, Job& job);

}  // namespace seedmesh::gltf
