#pragma once
/// Objects on the ground of a city: houses, landmarks, furniture, trees, hedges and fences.
#include <optional>

#include "core/generators/api.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/surface.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Adds all contents to the model. Spends Resource::triangles. Errors: those of the nested requests, such as
/// buildings and trees.
std::optional<Error> add_contents(Model& model, ChunkNodes& nodes, const Chunks& chunks,
                                  const Surface& surface, const CityParams& params,
                                  const GenerateContext& context);

/// Adds the triangles and bytes of all contents to an estimate. Generates one sample building for each rule,
/// number of floors and width class of 2 m, and one sample of each other model.
std::optional<Error> estimate_contents(Estimate& estimate, const Surface& surface, const CityParams& params,
                                       const GenerateContext& context);

}  // namespace seedmesh::city
