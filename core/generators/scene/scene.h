#pragma once
/// Scenes: many models on one ground.
///
///   params -> Ground (the height field of a terrain, or level ground)
///          -> place_layers(): computes the placements of each layer, and levels the ground under foundations
///          -> variant_table_of(): the requests of all models -> models_of(), in parallel
///          -> assembled(): one mesh for each model, nodes with copies
///
/// The model has the root "scene" with the ground, and a node for each layer with a node for each of its
/// models. Copies are Node::instances. The centre of the ground is at the origin of X and Z; north is -Z.
/// docs/scenes.md describes all rules.

#include "core/generators/api.h"
#include "core/gltf/payload.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct SceneParams;
}

namespace seedmesh::scene {

/// derive() lists at most this number of placements.
constexpr std::size_t most_listed = 100'000;

/// Returns all errors that the schema cannot express, with pointers relative to the parameters: nested
/// scenes, missing members of a method, unknown layer names, invalid variations. Generates nothing.
std::vector<Issue> check(const SceneParams& params, const CheckContext& context);

/// Generates the scene. Errors: those of check(), and those of the models and the terrain at their pointers.
Result<Model> generate(const SceneParams& params, const GenerateContext& context);

/// Returns {placements: [{model, translation, rotation, scale}], models: {name: request}, layers, warnings}.
/// Each model is a complete request. `placements` is null above most_listed.
Result<Json> derive(const SceneParams& params, const GenerateContext& context);

/// Returns the warnings of the models, and an estimate where the models and the ground have one (estimate.h).
/// Refuses a scene whose sum exceeds a limit.
Result<Appraisal> appraise(const SceneParams& params, const GenerateContext& context);

/// Returns an empty vocabulary, because scenes have no notation.
Json vocabulary();

/// Encodes the format "placements": a zip with placements.json and a file for each model.
Result<Payload> encode(const SceneParams& params, const WantedFormat& format, const GenerateContext& context);

}  // namespace seedmesh::scene
