#pragma once
/// What stands on the ground of a city: houses, landmarks, furniture, trees, hedges and fences.
#include <optional>

#include "core/generators/api.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/surface.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Adds all contents to the model. Spends Resource::triangles. Errors: those of requests inside.
std::optional<Error> add_contents(Model& model, ChunkNodes& nodes, const Chunks& chunks,
                                  const Surface& surface, const CityParams& params,
                                  const GenerateContext& context);

/// Adds the triangles and bytes of all contents to an estimate. One sample is made of each rule and number of floors,
/// and of each other model.
std::optional<Error> estimate_contents(Estimate& estimate, const Surface& surface, const CityParams& params,
                                       const GenerateContext& context);

}  // namespace seedmesh::city
