#pragma once
/// Ground, models and stands -> one model: a mesh for each model, and nodes with its copies.
#include "core/generators/scene/casts.h"
#include "core/generators/scene/plant.h"

namespace seedmesh::scene {

/// Everything that was found out before models were made. Does not own it.
struct Plan {
  const Ground& ground;
  Planting& planting;  ///< used up by assembled()
  const Casting& casting;
};

struct Pieces {
  Model ground;
  std::vector<Model> models;  ///< by Casting::casts
};

/// Nodes: "scene" - ground; "scene" - layer - model, with its copies in groups by area. Materials that differ
/// in nothing but the seed of their texture are one within a layer, and equal ones everywhere. Extras tell of
/// each layer how many stand and of how many models.
Model assembled(const SceneParams& params, const Plan& plan, Pieces pieces, Job& job);

}  // namespace seedmesh::scene
