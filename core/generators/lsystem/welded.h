#pragma once
/// Bark with continuous joints (the parameter `weld`): graft() joins limbs that are drawn in brackets with
/// their parents.
#include <optional>
#include <span>
#include <vector>

#include "core/geom/plant/skin.h"
#include "core/model/model.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

struct WeldedBark {
  std::vector<Bark> barks;
  /// The limbs of which the bark is made. Coincident internodes are removed, and a limb that ends in a fork
  /// is continued by one of its branches.
  Limbs limbs;
  Array<std::uint16_t> bones;  ///< bone of each joint; empty without growth animation
};

/// Returns the bark of the finest level. `bones` has one entry for each joint or is empty. Returns nullopt
/// where limbs overlap so much that graft() cannot make a surface.
std::optional<WeldedBark> welded_bark(const Limbs& limbs, std::span<const std::uint16_t> bones,
                                      const LsystemParams& params, Job& job);

/// Estimates the number of triangles, within 25 % if cross-sections have at least six corners and limbs
/// hardly overlap.
std::uint64_t welded_triangles(const Limbs& limbs, const LsystemParams& params, Job& job);

/// Adds a warning for each parameter that has no effect together with `weld`.
void warn_of_welded(const LsystemParams& params, std::vector<Warning>& warnings);

}  // namespace seedmesh::lsystem
