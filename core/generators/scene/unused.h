#pragma once
/// Warnings about parameters of a scene that are given and have no effect.
#include <vector>

#include "core/generators/api.h"

namespace seedmesh {
struct SceneParams;
}

namespace seedmesh::scene {

/// What is made of a scene.
enum class Purpose { model, list, derivation };

/// Returns a warning for each parameter that has no effect, whatever the positions of the copies are. `demand` is that of
/// a model; null for the other purposes.
std::vector<Warning> unused_settings(const SceneParams& params, Purpose purpose, const Demand* demand);

}  // namespace seedmesh::scene
