#pragma once
/// Levels of detail of a model, as its nodes have them.
#include <cstddef>

#include "core/model/model.h"

namespace seedmesh {

/// The most that a node has, the finest counted; at least 1.
std::size_t levels_of(const Model& model);

/// The mesh that a node shows at a level; one with fewer levels shows its coarsest. -1: none.
int mesh_at(const Node& node, std::size_t level);

}  // namespace seedmesh
