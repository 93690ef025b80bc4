#pragma once
/// Bark with grown joints (the parameter `weld`): limbs of brackets grown together by graft().
#include <optional>
#include <span>
#include <vector>

#include "core/geom/skin.h"
#include "core/model/model.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

struct WeldedBark {
  std::vector<Bark> barks;
  /// What it was made of: limbs in which nothing is drawn twice and each goes on as far as it can.
  Limbs limbs;
  Array<std::uint16_t> bones;  ///< of their joints, where the plant grows
};

/// The bark of the finest level; `bones` of each joint, or empty. Nullopt: the limbs lie in heaps, of which
/// graft() makes no surface.
std::optional<WeldedBark> welded_bark(const Limbs& limbs, std::span<const std::uint16_t> bones,
                                      const LsystemParams& params, Job& job);

/// About how many triangles it has; within a quarter for plants of six sides and more that are no heap.
std::uint64_t welded_triangles(const Limbs& limbs, const LsystemParams& params, Job& job);

/// What of the parameters welded bark does not look at.
void warn_of_welded(const LsystemParams& params, std::vector<Warning>& warnings);

}  // namespace seedmesh::lsystem
