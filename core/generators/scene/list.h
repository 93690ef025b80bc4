#pragma once
/// The list of placements, for the instancing of game engines.
#include "core/generators/api.h"
#include "core/generators/scene/forecast.h"
#include "core/generators/scene/place_layers.h"
#include "core/gltf/payload.h"
#include "core/schema/json.h"

namespace seedmesh::scene {

/// Returns the result of derive() for a scene (scene.h describes it).
Json placements_json(const SceneParams& params, const Ground& ground, const ScenePlacements& all_placements,
                     const VariantTable& variant_table, const Job& job);

/// Returns a zip with placements.json, which lists all placements, and models/<name>.glb. Numbers have enough
/// digits for a 32-bit float. `forecast` predicts the cost of generating each variant once. Spends output bytes. Cost:
/// below 1 microsecond for each placement on one thread.
Result<Payload> placement_list(const SceneParams& params, const Ground& ground,
                               const ScenePlacements& all_placements, Forecast& forecast,
                               const GenerateContext& context);

}  // namespace seedmesh::scene
