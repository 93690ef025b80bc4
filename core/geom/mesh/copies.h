#pragma once
/// Joins the copies of repeated meshes into one mesh.
#include "core/model/model.h"

namespace seedmesh {

/// Returns the number of copies of all meshes that are shown more than once, by several nodes or by Node::instances.
std::uint64_t count_copies(const Model& model);

/// Replaces all copies of meshes that are shown more than once by a new node "copies". Its mesh has one
/// primitive for each material, and as many levels of detail as any of the merged nodes; a node with fewer
/// levels shows its coarsest there. Attributes are kept, transforms are applied, and mirrored triangles are
/// reversed. The new node is a child of the first node if that is a static root without a transform. Nodes
/// that become empty are removed. Skinned and animated nodes, their descendants, and collision shapes are
/// left unchanged. Spends triangles for the additional copies. To be called before finish(). Linear time.
void merge_copies(Model& model, Job& job);

}  // namespace seedmesh
