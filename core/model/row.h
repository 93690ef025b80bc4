#pragma once
/// Models side by side in one.
#include <cstdint>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Stands the models in a row along +X, the first where it is, a fifth of the widest apart, each under a node
/// of its own named after it. Materials that differ in nothing but the seed of their textures become one, and
/// so do images with the same bytes and warnings that say the same. Model::variants are joined by name; the
/// extras of each model go to its node. `models` is not empty.
Model row_of(std::vector<Model> models);

}  // namespace seedmesh
