#pragma once
/// Parameters of a scene -> where everything stands. Layer after layer: places of its pattern, those that
/// suit its rules, and between crowns the larger ones.
///
/// Each layer draws from its own stream, so that no change of one moves another, but for what they are told
/// to heed of each other: footprints, near, shade, competition.
#include <vector>

#include "core/generators/scene/ground.h"

namespace seedmesh {
struct SceneLayer;
struct SceneParams;
}  // namespace seedmesh

namespace seedmesh::scene {

struct Planting {
  std::vector<Array<Stand>> layers;  ///< by SceneParams::layers
  std::vector<Warning> warnings;
};

/// Levels the ground under foundations. Spends a shape for every stand. Throws Stop (Code::invalid) where a
/// density image cannot be read. Under 1 microsecond a stand.
Planting plant(const SceneParams& params, Ground& ground, Job& job);

/// The stream of a layer: by its name, or its number where it has none.
Rng stream_of(const SceneLayer& layer, std::size_t number, const Job& job);

/// How a stand is put on the ground: origin, turn and lean, scale.
Transform transform_of(const Stand& stand, const SceneLayer& layer, const Ground& ground);

}  // namespace seedmesh::scene
