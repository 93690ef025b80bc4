#pragma once
/// Levels of detail of a model, as its nodes have them.
#include <cstddef>
#include <cstdint>

#include "core/model/model.h"

namespace seedmesh {

/// The most that a node has, the finest counted; at least 1.
std::size_t levels_of(const Model& model);

/// The mesh that a node shows at a level; one with fewer levels shows its coarsest. -1: none.
int mesh_at(const Node& node, std::size_t level);

/// What is drawn where the mesh is shown once.
std::uint64_t triangles_of(const MeshGroup& group);

}  // namespace seedmesh
