#pragma once
/// The leaves of a tree as meshes or places.
#include "core/generators/tree/growth_context.h"
#include "core/generators/tree/levels.h"
#include "core/generators/tree/looks.h"
#include "core/geom/organs.h"

namespace seedmesh::tree {

/// What moves leaves: bones of the joints, wind; both may be empty.
struct LeafMotion {
  std::span<const std::uint16_t> bones;
  const WindField* wind = nullptr;
};

/// The mesh of one leaf, 1 long.
Mesh leaf_of(const TreeParams& params, int level, const Job& job);

/// Leaves only those that are drawn, and gives them the size of the mesh.
void fit_leaves(Organs& organs, const TreeParams& params, const Job& job);

/// Adds the node "leaves" with all levels of detail, or, where the output asks for it, as places of one mesh.
/// `organs` were fitted. `model_size` is the diagonal of the tree.
void add_leaves(Model& model, const Organs& organs, const TreeParams& params, const LeafMotion& motion,
                TreeLevels& levels, float model_size, Job& job);

}  // namespace seedmesh::tree
