#pragma once
/// Levels of detail of an object with several meshes. If each mesh has levels of its own (MSFT_lod), engines
/// make a group of levels with its own bounds for each. The parts then change at different distances. Levels
/// of the root change together.
#include <cstddef>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::gltf {

/// Returns the nodes of an object whose root has the levels: children of one root that show meshes, in ascending
/// order. Empty where the parts keep their own levels: there is one part or no root, or a part has copies, children, a
/// transform, a skin, extras or other thresholds. Collision shapes are no parts.
std::vector<std::size_t> parts_of_object(const Model& model);

}  // namespace seedmesh::gltf
