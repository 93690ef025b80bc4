#pragma once
/// Prepares limbs drawn by a turtle for graft(): one of the side limbs at the end of a limb continues it.
///
/// A turtle ends a limb where all its successors are in brackets, and draws any number of limbs at one joint.
/// A fork needs a limb that continues, and joins one side limb to it.
#include <span>

#include "core/base/job.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh {

struct ContinuedLimbs {
  Limbs limbs;
  Array<std::uint32_t> moved;  ///< first joints of limbs that were moved down their parent, ascending
  /// Index of each joint in the input; a new joint has that of the joint that follows it.
  Array<std::uint32_t> original;
};

/// Changes limbs as follows:
/// - Where a limb ends in side limbs, the thickest and straightest of them continues it, unless that one is
///   much thinner or turns off sharply.
/// - Where a thick side limb leaves a joint, the other side limbs there are moved down the internode, to new
///   joints. Their distances are those that their forks need; limbs for which no joint fits stay.
/// - The limb tapers along these new joints to the radius of its continuation.
///
/// `stay`: for each joint, 1 where the limb that begins with it must not be moved; or empty. Existing joints
/// keep their positions and their order. Linear time, except for the sorting of many limbs at one joint.
ContinuedLimbs continue_limbs(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay = {});

}  // namespace seedmesh
