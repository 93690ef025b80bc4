#pragma once
/// Plants of a scene that grow: each place has bones of its own, which move one shared mesh, with the key
/// times of one shared animation.
#include <array>
#include <vector>

#include "core/base/job.h"
#include "core/generators/scene/assemble.h"

namespace seedmesh::scene {

/// Bones of all plants together.
constexpr std::size_t most_joints = 24'000;

/// Different starts within the span of a layer, so that plants share key times.
constexpr std::size_t starts_of_a_layer = 16;

/// When a plant begins.
struct Start {
  std::size_t number = 0;  ///< below starts_of_a_layer
  float seconds = 0;
};

/// By the place of the stand.
Start start_of(const SceneLayer& layer, const Stand& stand);

/// What a plant needs to grow, and its mesh with the bones in it. Empty joints: it stands still.
struct Grower {
  int mesh = -1;             ///< into the meshes of the scene
  std::vector<Node> joints;  ///< parents by their number here, -1: the place
  std::vector<glm::mat4> inverse_bind;
  Animation animation;                       ///< channels by the numbers of joints
  std::array<int, starts_of_a_layer> times;  ///< by start: where its key times begin in the scene's animation

  Grower() { times.fill(-1); }
};

/// Takes skin, animation and the primitives that they move out of the model, materials as they are numbered
/// there. No joints where the model does not grow.
struct Taken {
  Grower grower;
  std::vector<Primitive> primitives;
};
Taken taken_to_grow(Model& model);

/// Where a plant stands, and from when on it grows.
struct Plot {
  std::string name;
  Transform at;
  int parent = -1;
  Start start;
};

/// Adds a plant to the scene.
void add_grower(Model& scene, Grower& grower, const Plot& plot);

/// How many bones each plant may have. Issue: there are more plants than bones.
Result<std::uint32_t> bones_for(const Plan& plan);

}  // namespace seedmesh::scene
