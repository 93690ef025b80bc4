#pragma once
/// Where everything stands as a list: what engines feed to their own instancing.
#include "core/generators/scene/forecast.h"
#include "core/generators/scene/plant.h"
#include "core/gltf/payload.h"
#include "core/schema/json.h"

namespace seedmesh::scene {

/// The answer of derive(): see scene.h.
Json told(const SceneParams& params, const Ground& ground, const Planting& planting, const Casting& casting,
          const Job& job);

/// A zip of placements.json, which has all stands, and models/<name>.glb. Numbers have as many digits as a
/// 32-bit float needs. `forecast`: of all models, each once. Spends output bytes. Below 1 microsecond a stand
/// on one thread.
Result<Payload> placement_list(const SceneParams& params, const Ground& ground, const Planting& planting,
                               Forecast& forecast, Job& job);

}  // namespace seedmesh::scene
