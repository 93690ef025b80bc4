#pragma once
/// Wind weights of a plant: four numbers a vertex. There is no standard; docs/trees.md shows how the shaders
/// of common engines use them.
///
///   TEXCOORD_2 = (bend of the trunk, bend of the branch)   TEXCOORD_3 = (phase of the branch, flutter)
///
/// - The trunk bends by the square of the height.
/// - A branch bends by 0 at the trunk and more along its length, most where it is long and thin. What grows
///   from it begins with its bend. A branch of the trunk and everything on it have one phase.
/// - Bark has no flutter. A leaf moves as a whole with its limb and flutters from 0 at its base to 1 at its
///   tip.
///
/// The weights are continuous at joints, so the surface does not tear.
#include <span>

#include "core/geom/plant/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

class WindField {
 public:
  /// Linear time; 8 bytes a joint. Borrows the limbs.
  WindField(const Limbs& limbs, Job& job);
  /// The field of a coarser level. `was`: for each joint, its number at the finest level, whose weights it
  /// gets.
  WindField(const Limbs& limbs, std::span<const std::uint32_t> was, const WindField& finest, Job& job);

  /// Returns the bend (0..1) and phase at a point of the internode of `joint`; (0, 0) without a joint.
  glm::vec2 at(std::uint32_t joint, const glm::vec3& point) const;
  float trunk_bend(float height) const;

 private:
  const Limbs& limbs_;
  Array<glm::vec2> sway_;  ///< sway at each joint
  float height_ = 0, most_ = 1e-9F, thickest_ = 1e-9F;
};

/// Fills uv[2] and uv[3]. `joint` has the joint of each vertex.
void add_wind(Mesh& mesh, const Array<std::uint32_t>& joint, const WindField& wind, const Job& job);

}  // namespace seedmesh
