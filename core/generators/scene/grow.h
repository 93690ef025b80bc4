#pragma once
/// Plants of a scene that grow: each place has bones of its own, which move one shared mesh, with the key
/// times of one shared animation.
#include <vector>

#include "core/base/job.h"
#include "core/generators/scene/assemble.h"

namespace seedmesh::scene {

/// Bones of all plants together.
constexpr std::size_t most_joints = 24'000;

/// What a plant needs to grow, and its mesh with the bones in it. Empty joints: it stands still.
struct Grower {
  int mesh = -1;             ///< into the meshes of the scene
  std::vector<Node> joints;  ///< parents by their number here, -1: the place
  std::vector<glm::mat4> inverse_bind;
  Animation animation;  ///< channels by the numbers of joints
  int times = -1;       ///< where its key times begin in the scene's animation
};

/// Takes skin, animation and the primitives that they move out of the model, materials as they are numbered
/// there. No joints where the model does not grow.
struct Taken {
  Grower grower;
  std::vector<Primitive> primitives;
};
Taken taken_to_grow(Model& model);

/// Adds a plant to the scene at `at`, below the node `parent`.
void add_grower(Model& scene, Grower& grower, const std::string& name, const Transform& at, int parent);

/// How many bones each plant may have. Issue: there are more plants than bones.
Result<std::uint32_t> bones_for(const Plan& plan);

}  // namespace seedmesh::scene
