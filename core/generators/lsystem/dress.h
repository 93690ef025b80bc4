#pragma once
/// Skeleton -> Model: bark or lines, surfaces, materials.
#include "core/generators/appraisal.h"
#include "core/geom/limbs.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

Model dress(Skeleton skeleton, const LsystemParams& params, Job& job);

/// How many segments may be drawn within limits.triangles; a segment drawn on top of another counts too.
std::uint64_t most_segments(const LsystemParams& params, const Limits& limits);

/// Size of a model with welded bark, whose skeleton has its widths.
Estimate estimate_of(const Skeleton& skeleton, const LsystemParams& params, Job& job);

/// Size of a model of so many drawn segments, each limb of which is a tube.
Estimate estimate_of(std::uint64_t segments, std::uint64_t limbs, const LsystemParams& params);

}  // namespace seedmesh::lsystem
