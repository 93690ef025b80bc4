#pragma once
/// Growth animation: bones for Limbs, and the glTF skin and animation made of them, for every generator that
/// writes Limbs.
///
///   plan_growth(limbs) -> GrowthPlan -> skin(limbs, {.bones = plan.bone}), polygons(.., plan.bone)
///                                    -> add_growth(model, plan)
///
/// A bone is a piece of a limb, or a twig with all that it carries. Its node is at the start of the piece, and
/// is a child of the node of the bone that it grows from. Only a uniform scale is animated. This has the
/// following effects:
/// - At any time and with any interpolation a limb stays on its parent and normals stay correct.
/// - The bark stays closed: the ring between two pieces belongs to the older one, and the younger piece is a
///   point there until it is born.
/// - At the end all scales are 1: the animation ends in the still model, bit for bit.
/// - Coarser levels of detail use the same bones.
///
/// At time t, a piece with birth b has the share 1 - (1 - x)^2 of its final size. Here x = (t - b) / (1 - b), and t
/// and b are from 0 to 1. Old pieces therefore continue to grow while young ones start. The scale of a node is the
/// share of its piece divided by that of its parent.

#include "core/geom/plant/limbs.h"
#include "core/model/model.h"

namespace seedmesh {

struct GrowthOptions {
  std::uint32_t most_bones = 240;  ///< joint numbers then fit a byte; smaller pieces share bones
  double seconds = 8;
};

struct Bone {
  glm::vec3 position{0};  ///< position where it begins
  std::int32_t parent = -1;
  std::uint32_t born = 0;  ///< class of birth, 0..birth_classes-1
};

struct GrowthPlan {
  static constexpr std::uint32_t birth_classes = 24;

  std::vector<Bone> bones;    ///< parents first; the first is the ground, at the origin
  Array<std::uint16_t> bone;  ///< bone that moves the internode of each joint
  /// Whether the bone of the ground is scaled too, because there is no limb, or there are too many plants.
  bool ground_grows = false;
  double seconds = 8;

  std::uint16_t bone_of(std::uint32_t joint) const { return joint == Limbs::none ? 0 : bone[joint]; }
};

/// Births are Limbs::birth in any unit; where it is empty, an internode is born by its distance from the root
/// along the limbs. The bones are the pieces that carry the greatest length. O(n log n).
GrowthPlan plan_growth(const Limbs& limbs, const GrowthOptions& options, Job& job);

/// Adds the nodes of the bones under the first node, a skin, and the animation "growth". Nodes whose mesh has
/// Mesh::bone become skinned and are moved to the root of the scene, since glTF places a skinned mesh by its
/// bones.
void add_growth(Model& model, const GrowthPlan& plan);

}  // namespace seedmesh
