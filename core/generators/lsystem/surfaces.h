#pragma once
/// The request's surfaces as meshes, and organs as a part of the model.
#include "core/generators/lsystem/looks.h"
#include "core/geom/limbs.h"

namespace seedmesh::lsystem {

/// What the schema cannot say of the surfaces.
void check_surfaces(const LsystemParams& params, std::vector<Issue>& issues);

/// Organs and what they stand on.
struct Foliated {
  const Organs& organs;
  float size = 0;                             ///< the diagonal of the model
  std::span<const std::uint16_t> bones = {};  ///< of each joint, where the plant grows
};

/// Adds the node "organs" with all of them: merged into one primitive for each surface and look, or, where
/// the output asks for it, as nodes that share one mesh for each. A surface that is a model of its own has a
/// primitive for each of its materials, which come along. Throws Stop (Code::invalid) where such a model
/// cannot be made or has no triangles.
void add_organs(Model& model, const Foliated& foliated, const LsystemParams& params, Wardrobe& wardrobe,
                Job& job);

}  // namespace seedmesh::lsystem
