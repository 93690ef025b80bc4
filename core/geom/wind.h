#pragma once
/// Wind weights of a plant: four numbers a vertex from which shaders of any engine make theirs, as no
/// standard exists (docs/trees.md has the table).
///
///   TEXCOORD_2 = (bend of the trunk, bend of the branch)   TEXCOORD_3 = (phase of the branch, flutter)
///
/// The trunk bends by the square of the height. A branch bends from 0 at the trunk on, farther where it is
/// long and thin, and hands its bend on to what grows from it; the phase is one for a branch with all that it
/// carries. So the weights change continuously over joints, and nothing tears. Bark has no flutter; a leaf
/// moves whole with its limb and flutters from 0 at its base to 1 at its tip.
#include <span>

#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

class WindField {
 public:
  /// Linear time; 8 bytes a joint. Borrows the limbs.
  WindField(const Limbs& limbs, Job& job);
  /// Of a coarser level: `was` is of each joint which one of the finest level it was, so that both agree.
  WindField(const Limbs& limbs, std::span<const std::uint32_t> was, const WindField& finest, Job& job);

  /// The bend (0..1) and phase at a point of the internode of `joint`; (0, 0) without a joint.
  glm::vec2 at(std::uint32_t joint, const glm::vec3& point) const;
  float trunk_bend(float height) const;

 private:
  const Limbs& limbs_;
  Array<glm::vec2> sway_;  ///< at each joint
  float height_ = 0, most_ = 1e-9F, thickest_ = 1e-9F;
};

/// Fills uv[2] and uv[3]; `joint` has the joint of each vertex.
void add_wind(Mesh& mesh, const Array<std::uint32_t>& joint, const WindField& wind, const Job& job);

}  // namespace seedmesh
