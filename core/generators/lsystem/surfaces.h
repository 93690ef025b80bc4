#pragma once
/// The request's surfaces as meshes, and organs as a part of the model.
#include "core/generators/lsystem/looks.h"
#include "core/geom/limbs.h"

namespace seedmesh::lsystem {

/// What the schema cannot say of the surfaces.
void check_surfaces(const LsystemParams& params, std::vector<Issue>& issues);

/// Adds the node "organs" with all of them: merged into one primitive for each surface and look, or, where
/// the output asks for it, as nodes that share one mesh for each. `size` is the diagonal of the model.
void add_organs(Model& model, const Organs& organs, const LsystemParams& params, float size,
                Wardrobe& wardrobe, Job& job);

}  // namespace seedmesh::lsystem
