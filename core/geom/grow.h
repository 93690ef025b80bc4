#pragma once
/// A skeleton that grows: a plan of bones over Limbs, and the glTF skin and animation made of it, for every
/// generator that writes Limbs.
///
///   plan_growth(limbs) -> GrowthPlan -> skin(limbs, {.bones = plan.bone}), polygons(.., plan.bone)
///                                    -> add_growth(model, plan)
///
/// A bone is a piece of a limb, or a twig with all that it carries. Its node stands where the piece begins
/// and hangs under the node of the bone that it grows from; nothing but a uniform scale is animated. So
/// whatever the time and however a player interpolates, a limb stays on its parent, normals stay right, and
/// the bark stays closed: the ring between two pieces belongs to the older one, and the younger is a point
/// there until it is born. At the end all scales are 1: the animation ends in the still model, byte by byte.
/// Coarser levels of detail are skinned with the same bones.
///
/// A piece of birth b has at the time t (both 0..1) the size 1 - (1 - x)^2, x = (t - b) / (1 - b), of its own
/// last size: old pieces grow on while young ones start. Its node has the ratio of that to its parent's size.
#include <span>

#include "core/geom/limbs.h"
#include "core/model/model.h"

namespace seedmesh {

struct GrowthOptions {
  std::uint32_t most_bones =
      240;  ///< joint numbers then fit a byte; what is too small gets no bone of its own
  double seconds = 8;
};

struct Bone {
  glm::vec3 position{0};  ///< where it begins
  std::int32_t parent = -1;
  std::uint32_t born = 0;  ///< class of birth, 0..birth_classes-1
};

struct GrowthPlan {
  static constexpr std::uint32_t birth_classes = 24;

  std::vector<Bone> bones;    ///< parents first; the first is the ground, at the origin
  Array<std::uint16_t> bone;  ///< of each joint: the one that moves its internode
  bool ground_grows = false;  ///< the ground's bone has a size too: there is no limb, or too many plants
  double seconds = 8;

  std::uint16_t bone_of(std::uint32_t joint) const { return joint == Limbs::none ? 0 : bone[joint]; }
};

/// Births are those of Limbs::birth, in whatever unit; where it is empty, an internode is born by its
/// distance from the root along the limbs. The bones are the pieces that carry the greatest length. n log n
/// time.
GrowthPlan plan_growth(const Limbs& limbs, const GrowthOptions& options, Job& job);

/// Adds the nodes of the bones under the first node, a skin, and the animation "growth", and makes all nodes
/// whose mesh has Mesh::bone skinned; these leave their parents, since glTF places a skinned mesh by its
/// bones.
void add_growth(Model& model, const GrowthPlan& plan);

}  // namespace seedmesh
