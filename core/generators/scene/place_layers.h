#pragma once
/// Places the models of a scene, layer by layer. The pattern of a layer gives candidate positions, the rules filter
/// them, and crowns compete for the rest.
///
/// Each layer has its own random stream, so changing one layer does not change others, except through
/// footprints, near, shade and competition.
#include <vector>

#include "core/generators/scene/ground.h"

namespace seedmesh {
struct SceneLayer;
struct SceneParams;
}  // namespace seedmesh

namespace seedmesh::scene {

/// The placements of all layers.
struct ScenePlacements {
  std::vector<Array<Placement>> layers;  ///< indexed by SceneParams::layers
  std::vector<Warning> warnings;
};

/// Computes all placements and levels the ground under foundations. Spends one shape for each placement.
/// Throws Stop (Code::invalid) for an unreadable density image. Cost: below 1 microsecond for each placement.
ScenePlacements place_layers(const SceneParams& params, Ground& ground, Job& job);

/// Returns the largest number of positions that are tried for a layer with the method scatter or clusters.
std::size_t tries_of_series(const SceneLayer& layer);

/// Returns the random stream of a layer, from its name, or from its number without a name.
Rng stream_of(const SceneLayer& layer, std::size_t number, const Job& job);

/// Returns the transform of a placement: position on the ground, turn, lean and scale.
Transform transform_of(const Placement& placement, const SceneLayer& layer, const Ground& ground);

}  // namespace seedmesh::scene
