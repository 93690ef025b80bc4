#pragma once
/// The leaves of a tree as meshes or places.
#include <optional>

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

/// Gives leaves, as they were grown, the size of the mesh of one, `leaf`.
void fit_leaves(Organs& organs, const TreeParams& params, const Mesh& leaf, const Job& job);

/// Leaves that were fitted; `model_size` is the diagonal of the tree, `leaf` one of the finest level.
/// Borrowed.
struct Leaves {
  const Organs& organs;
  const Mesh& leaf;
  const TreeParams& params;
  const LeafMotion& motion;
  float model_size;
};

/// The finest level of leaves that are not places of one mesh, yet to be made. `leaves` is borrowed.
OrganPlacing finest_leaves(const Leaves& leaves, Job& job);

/// Adds the node "leaves" with all levels of detail, or, where the output asks for it, as places of one mesh.
/// `finest`: what finest_leaves() has made, where it was asked before.
void add_leaves(Model& model, const Leaves& leaves, TreeLevels& levels,
                std::optional<std::vector<Foliage>> finest, Job& job);

}  // namespace seedmesh::tree
