#pragma once
/// Meshes that stand more than once, and one mesh made of all of them.
#include "core/model/model.h"

namespace seedmesh {

/// How many times meshes are shown that are shown more than once, by a node for each or by Node::instances.
std::uint64_t count_copies(const Model& model);

/// Puts every mesh that is shown more than once where it is shown: one new node "copies", below the first
/// node if that stands still where it is, has a mesh with a primitive for each material, and coarser levels
/// if a node had any (one with fewer shows its coarsest there). Attributes stay, transforms are applied,
/// mirrored triangles are turned round. Nodes that are bare then go. What moves (skinned, animated, on an
/// animated parent) and collision shapes are left as they are. Spends triangles for what is drawn more than
/// once. Not after finish(). Linear time.
void merge_copies(Model& model, Job& job);

}  // namespace seedmesh
