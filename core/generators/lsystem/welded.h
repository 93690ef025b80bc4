#pragma once
/// Bark with grown joints (the parameter `weld`): limbs of brackets grown together by graft().
#include <optional>
#include <span>
#include <vector>

#include "core/geom/skin.h"
#include "core/model/model.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

struct BarkUse {
  std::span<const std::uint16_t> bones;  ///< of each joint, where the plant grows
  bool carries_organs = false;
};

/// Of each joint, how much of it is seen between the others.
Array<float> shown_of(const Limbs& limbs, Job& job);

/// How many triangles the bark of a level may have, the finest having `finest`.
std::uint64_t wanted_triangles(int level, std::uint64_t finest, const BarkUse& use);

/// All levels of detail that the job demands and that have fewer triangles each than the one before, the
/// finest first. Nullopt: the limbs lie in heaps, of which graft() makes no surface.
std::optional<std::vector<std::vector<Bark>>> welded_levels(const Limbs& limbs, const BarkUse& use,
                                                            const LsystemParams& params, Job& job);

/// About how many triangles the finest level has; within a quarter for plants that are no heap.
std::uint64_t welded_triangles(const Limbs& limbs, const LsystemParams& params, Job& job);

/// What of the parameters welded bark does not look at.
void warn_of_welded(const LsystemParams& params, std::vector<Warning>& warnings);

}  // namespace seedmesh::lsystem
