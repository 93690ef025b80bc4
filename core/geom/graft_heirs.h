#pragma once
/// Limbs as graft() can join them, of limbs as a turtle draws them in brackets.
///
/// A turtle ends a limb where all that grows on is in brackets, and sets as many limbs at one joint as it is
/// told; a fork needs a limb that goes on, and has room for one other.
#include "core/base/job.h"
#include "core/geom/limbs.h"

namespace seedmesh {

struct HeirLimbs {
  Limbs limbs;
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
/// Joints that were there stay where they are and keep their order. Linear time but for many limbs at a
/// joint.
HeirLimbs with_heirs(const Limbs& limbs, Job& job);

}  // namespace seedmesh
