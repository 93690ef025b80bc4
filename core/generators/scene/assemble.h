#pragma once
/// Assembles the model of a scene: one mesh for each model variant, and nodes with its copies.
#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/place_layers.h"

namespace seedmesh::scene {

/// Inputs of assembled() that exist before the models. Does not own them.
struct Plan {
  const Ground& ground;
  ScenePlacements& all_placements;  ///< consumed by assembled()
  const VariantTable& variant_table;
};

struct Pieces {
  Model ground;
  std::vector<Model> models;  ///< indexed by VariantTable::variants
};

/// Returns the scene as one model. Nodes: "scene" > ground; "scene" > layer > variant, whose copies are
/// grouped by area. Equal materials are shared; within a layer, materials that differ only in the seed of
/// their texture are shared too. Extras list the number of placements and models of each layer.
Model assembled(const SceneParams& params, const Plan& plan, Pieces pieces, const GenerateContext& context);

}  // namespace seedmesh::scene
