#pragma once
/// The leaves of a tree as merged meshes or as instances of one mesh.
#include <optional>

#include "core/generators/api.h"
#include "core/generators/tree/levels.h"
#include "core/generators/tree/materials.h"
#include "core/generators/tree/skeleton_writer.h"
#include "core/geom/plant/organs.h"

namespace seedmesh::tree {

/// What moves leaves: bones of the joints, and wind. Both may be empty.
struct LeafMotion {
  std::span<const std::uint16_t> bones;
  const WindField* wind = nullptr;
};

/// Returns the mesh of a leaf of length 1, with faces on one side.
Mesh leaf_of(const TreeParams& params, int level, const Job& job);

/// The same. If leaves have outward faces, the mesh has each face a second time, with vertices of its own and
/// opposite winding. The second faces are 0.003 of the length below the first ones.
Mesh drawn_leaf(const TreeParams& params, int level, const GenerateContext& context);

/// The vertex colours of the leaves, or none where all leaves have the same colour. `leaf`: drawn_leaf() of the
/// finest level, which `organs` fit.
std::optional<FoliageShade> shade_of(const Limbs& limbs, const Organs& organs, const Mesh& leaf,
                                     const TreeParams& params, const GenerateContext& context);

/// Converts the scales of leaves from length and width to factors for the mesh `leaf`.
void fit_leaves(Organs& organs, const TreeParams& params, const Mesh& leaf, const Job& job);

/// Leaves after fit_leaves(), borrowed. `leaf` is the mesh of the finest level.
struct Leaves {
  const Organs& organs;
  const Mesh& leaf;
  const TreeParams& params;
  const LeafMotion& motion;
  float model_size;           ///< diagonal of the bounding box of the tree
  const FoliageShade* shade;  ///< may be null
};

/// Adds the node "leaves" with all levels of detail, or instances of one mesh if context.demand.share_organs.
void add_leaves(Model& model, const Leaves& leaves, TreeLevels& levels, const GenerateContext& context);

}  // namespace seedmesh::tree
