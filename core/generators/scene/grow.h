#pragma once
/// Growing plants of a scene. Placements share the mesh and the key times of the animation; each has its own
/// skeleton.
#include <array>
#include <vector>

#include "core/base/job.h"
#include "core/generators/scene/assemble.h"

namespace seedmesh::scene {

/// Largest number of bones in a scene, of all plants together.
constexpr std::size_t most_joints = 24'000;

/// Number of distinct start times of a layer, so that plants share key times.
constexpr std::size_t starts_of_a_layer = 16;

/// The start of a plant's growth.
struct Start {
  std::size_t number = 0;  ///< number below starts_of_a_layer
  float seconds = 0;
};

/// Returns the start for a placement, from its key.
Start start_of(const SceneLayer& layer, const Placement& placement);

/// Data for the growth of a plant variant, and its skinned mesh. Without joints the plant does not grow.
struct GrowingPlant {
  int mesh = -1;             ///< index into the meshes of the scene
  std::vector<Node> joints;  ///< parents are indices into this list; -1: the placement
  std::vector<glm::mat4> inverse_bind;
  Animation animation;  ///< channel targets are indices into `joints`
  /// by start: index of the first of its Animation::times in the scene; -1: none
  std::array<int, starts_of_a_layer> times;

  GrowingPlant() { times.fill(-1); }
};

/// The skin, animation and skinned primitives of a model. Materials keep their indices. Without growth there
/// are no joints.
struct ExtractedPlant {
  GrowingPlant growing_plant;
  std::vector<Primitive> primitives;
};
ExtractedPlant extract_growing_plant(Model& model);

/// The transform and start of one growing plant.
struct PlantInstance {
  std::string name;
  Transform at;
  int parent = -1;
  Start start;
};

/// Adds a growing plant to the scene.
void add_growing_plant(Model& scene, GrowingPlant& growing_plant, const PlantInstance& plot);

/// Returns the number of bones of each plant. Issue: with two bones for each plant, the plants would have
/// more than most_joints bones.
Result<std::uint32_t> bones_for(const Plan& plan, GeneratorList generators);

}  // namespace seedmesh::scene
