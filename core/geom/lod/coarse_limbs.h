#pragma once
/// Simplification of limbs for the coarser levels of detail of a plant. It removes the joints and twigs whose removal
/// changes the outline least in proportion to the triangles that it saves.
///
/// Joints of a limb are selected after Douglas and Peucker, "Algorithms for the reduction of the number of
/// points required to represent a digitized line or its caricature", 1973; the error is the area by which the
/// outline changes. Whole twigs are removed: thin, short and hidden ones first. Both decisions compare
/// the error with the number of triangles times a Lagrange multiplier, which bisection finds. For skin() the
/// multiplier also decides how many corners each limb has; thick limbs keep more.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/plant/limbs.h"
#include "core/geom/plant/skin.h"

namespace seedmesh {

struct CoarseOptions {
  std::uint64_t triangles = 0;  ///< approximate target, counted as closed tubes
  /// The options of the finest level where skin() makes the bark; null where graft() makes it. skin() allows
  /// different barks and cross-sections along a limb; joints where those change are kept.
  const SkinOptions* skin = nullptr;
  bool was_grafted = false;  ///< graft() makes the finest level, skin() the coarser ones
  int sides = 8;             ///< corners of the thickest limb at this level, for graft()
  int finest_sides = 8;      ///< the same at the finest level; limbs with fewer corners become thicker
  bool pointed = false;      ///< thin ends have no ring (GraftOptions::pointed)
  std::span<const float> shown = {};          ///< visible share 0..1 of each joint; empty: all visible
  std::span<const glm::vec3> drawn = {};      ///< positions of joints in the finest level; empty: unchanged
  std::span<const std::uint16_t> bones = {};  ///< bone of each joint; joints where the bone changes are kept
};

struct CoarseLimbs {
  Limbs limbs;
  Array<std::uint32_t> was;  ///< index of each joint in the original limbs
  /// For skin(): for each joint the corners of its limb (SkinOptions::corners). The limbs then have keys,
  /// which give them the same rotation as at the finest level.
  std::vector<LimbCorners> corners;
};

/// Returns the simplified limbs, parents before children, limb by limb. Time: n log m for n joints, of which the
/// longest limb has m.
CoarseLimbs coarsen(const Limbs& limbs, const CoarseOptions& options, Job& job);

}  // namespace seedmesh
