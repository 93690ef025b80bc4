#pragma once
/// Limbs with fewer joints and fewer twigs, for the coarser levels of detail of a plant: what is left out is
/// what changes the outline least for the triangles that it costs.
///
/// Of each limb the joints stay that are farthest from the line between those that stay already (Douglas and
/// Peucker, "Algorithms for the reduction of the number of points required to represent a digitized line or
/// its caricature", 1973), measured as the area by which the outline changes; twigs go whole, thin, short and
/// hidden ones first. One price of a triangle, found by halving, decides about both, and for skin() also how
/// many corners each limb has: thick ones keep more.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/limbs.h"
#include "core/geom/skin.h"

namespace seedmesh {

struct CoarseOptions {
  std::uint64_t triangles = 0;  ///< about so many are wanted, counted as closed tubes
  /// Of the finest level, where skin() makes the bark: it has different barks and cross-sections along a
  /// limb, so that joints stay where those change. Null: graft() makes it.
  const SkinOptions* skin = nullptr;
  bool was_grafted = false;  ///< the finest level is graft()'s, coarser ones are skin()'s
  int sides = 8;             ///< for graft(): corners of the thickest limb at this level,
  int finest_sides = 8;      ///< and at the finest: limbs of fewer corners become thicker, as wide to see
  bool pointed = false;      ///< thin ends have no ring (GraftOptions::pointed)
  std::span<const float> shown = {};          ///< of each joint, how much of it is seen; empty: all
  std::span<const glm::vec3> drawn = {};      ///< where the finest level draws the joints; empty: at them
  std::span<const std::uint16_t> bones = {};  ///< of each joint; where they change, joints stay
};

struct CoarseLimbs {
  Limbs limbs;
  Array<std::uint32_t> was;  ///< of each joint: which one it was
  /// For skin(), of each joint those of its limb (SkinOptions::corners). The limbs have keys then, by which
  /// they turn as at the finest level.
  std::vector<LimbCorners> corners;
};

/// Linear time but for the logarithm of the longest limb. Parents come before children, limb by limb.
CoarseLimbs coarsen(const Limbs& limbs, const CoarseOptions& options, Job& job);

}  // namespace seedmesh
