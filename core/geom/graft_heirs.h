#pragma once
/// Limbs as graft() can join them, of limbs as a turtle draws them in brackets.
///
/// A turtle ends a limb where all that grows on is in brackets, and sets as many limbs at one joint as it is
/// told; a fork needs a limb that goes on, and has room for one other.
#include <span>

#include "core/base/job.h"
#include "core/geom/limbs.h"

namespace seedmesh {

struct HeirLimbs {
  Limbs limbs;
  Array<std::uint32_t> apart;  ///< first joints of limbs that leave an internode before its end, rising
  Array<std::uint32_t>
      was;  ///< of each joint, the one that it was; of one that was put in, the next of its limb
};

/// - Where a limb ends in others, the thickest and straightest goes on in its place, unless it is much
/// thinner
///   or turns off sharply.
/// - Where a thick limb leaves a joint, the others there leave a little before it, as far apart as their
/// forks
///   need, from joints of their own on the internode, as many as have room; the limb tapers there to what
///   goes on.
/// `stay`: of each joint, 1 where the limb that it begins is not to leave before; or empty.
/// Joints that were there stay where they are and keep their order. Linear time but for many limbs at a
/// joint.
HeirLimbs with_heirs(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay = {});

}  // namespace seedmesh
