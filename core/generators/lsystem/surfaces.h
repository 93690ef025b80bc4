#pragma once
/// Meshes of the surfaces of a request, and the organs as a node of the model.
#include "core/generators/api.h"
#include "core/generators/lsystem/materials.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh::lsystem {

/// Adds the errors of surfaces that the schema cannot express.
void check_surfaces(const LsystemParams& params, std::vector<Issue>& issues);

/// Organs with the size and bones of their plant.
struct PlantOrgans {
  const Organs& organs;
  float size = 0;                             ///< diagonal of the model's bounds, in metres
  std::span<const std::uint16_t> bones = {};  ///< bone of each joint; empty without growth animation
};

/// Adds the node "organs". Organs are merged into one primitive for each surface and material; with shared
/// output they become nodes that share one mesh. A surface that is a model has a primitive for each of its
/// materials, which are added to `model`. Throws Stop (Code::invalid) where such a model cannot be made or
/// has no triangles.
void add_organs(Model& model, const PlantOrgans& plant_organs, const LsystemParams& params,
                MaterialSet& material_set, const GenerateContext& context);

}  // namespace seedmesh::lsystem
