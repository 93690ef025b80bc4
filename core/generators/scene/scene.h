#pragma once
/// Scenes: many models on one ground.
///
///   params -> Ground (a terrain's height field, or level)
///          -> plant(): Stands of each layer, and foundations into the ground
///          -> casting_of(): the requests of all models -> models_of(), in parallel
///          -> assembled(): one mesh a model, nodes with copies
///
/// Out: root "scene"; below it the ground, and a node for each layer with a node for each of its models,
/// whose copies are Node::instances. The middle of the ground is at the origin of X and Z, north is -Z.
/// docs/scenes.md tells every rule.
#include <span>
#include <string_view>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/gltf/payload.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct SceneParams;
}

namespace seedmesh::scene {

/// Stands up to this many are told one by one by derive().
constexpr std::size_t most_told = 100'000;

/// Every fault between parameters, with pointers relative to them: scenes inside, rules that lack what their
/// method needs, names that no layer has, variations that a model refuses. Makes nothing.
std::vector<Issue> check(const SceneParams& params, const Limits& limits);

/// The model. Issues: those of check(), and of the models and the terrain at their pointers.
Result<Model> generate(const SceneParams& params, Job& job);

/// {placements: [{model, translation, rotation, scale}], models: {name: request}, layers, warnings}: every
/// model as a request that can be made alone; placements null where there are more than most_told.
Result<Json> derive(const SceneParams& params, Job& job);

/// Warnings of the models, and an estimate where all of them and the ground can tell theirs (estimate.h).
/// Refuses what is too large together.
Result<Appraisal> appraise(const SceneParams& params, const Job& job);

/// No notation, hence no words.
Json vocabulary();

/// The form "placements": a zip with placements.json (of all stands) and each model as a file of its own.
Result<Payload> encode(const SceneParams& params, std::string_view format, Job& job);

}  // namespace seedmesh::scene
