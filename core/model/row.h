#pragma once
/// Joins models side by side.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Places the models in a row along +X, each under a node with the model's name. The first keeps its
/// position; gaps are a fifth of the widest model. Materials that differ only in the seed of their textures
/// are shared, and so are images with the same bytes and equal warnings. Model::variants are joined by name.
/// The extras of each model move to its node. `models` must not be empty.
Model row_of(std::vector<Model> models);

}  // namespace seedmesh
