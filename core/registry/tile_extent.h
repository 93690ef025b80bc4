#pragma once
/// Generators whose models are tiles of one world.
#include "core/generators/api.h"

namespace seedmesh {

/// Returns the extent in metres for which quantized files choose the step of their grid
/// (WriteOptions::least_extent). It is the same for all tiles of one world, and 0 if the model is no tile.
float tile_extent(const Generator& generator, const Generator::Params& params);

}  // namespace seedmesh
