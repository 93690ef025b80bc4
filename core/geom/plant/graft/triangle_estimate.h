#pragma once
/// Estimates how many triangles graft() writes.
#include "core/geom/plant/graft/graft.h"

namespace seedmesh {

/// Counts rings, loops and junctions as if every junction fitted. A limb whose junction does not fit has slightly
/// fewer triangles, and a crease slightly more. The estimate is within a quarter of the true number for trees whose
/// limbs do not overlap. Linear time, a twentieth of that of graft().
std::uint64_t graft_triangles(const Limbs& limbs, const GraftOptions& options, Job& job);

}  // namespace seedmesh
