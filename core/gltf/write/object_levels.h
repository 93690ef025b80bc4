#pragma once
/// Levels of detail of an object with several meshes. If each mesh has levels of its own (MSFT_lod), engines
/// compute the bounds of each mesh separately. The levels of the parts then change at different distances. If
/// the root has the levels, all parts change together.
#include <cstddef>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::gltf {

/// Returns the nodes of an object whose root has the levels: children of one root that show meshes, in ascending
/// order. Returns an empty list if the parts keep their own levels. This is so if there is only one part or
/// no root. It is also so if a part has copies, children, a transform, a skin, extras or other thresholds.
/// Collision shapes do not count as parts.
std::vector<std::size_t> parts_of_object(const Model& model);

}  // namespace seedmesh::gltf
