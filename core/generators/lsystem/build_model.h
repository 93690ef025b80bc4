#pragma once
/// Converts a skeleton to a model: bark or lines, organ surfaces, materials.
#include <span>
#include <vector>

#include "core/generators/api.h"
#include "core/geom/plant/limbs.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// A skeleton that occurs several times, with one transform each.
struct SharedPart {
  Skeleton* skeleton;  ///< not owned, never null; build_model() moves its arrays out
  std::vector<Transform> transforms;
};

/// Makes the model of a skeleton. `parts`, which have limbs only, become nodes with copies.
Model build_model(Skeleton skeleton, const LsystemParams& params, const GenerateContext& context,
                  std::span<SharedPart> parts = {});

/// Returns the largest number of segments that can be drawn within limits.triangles. Each of several coincident
/// segments counts.
std::uint64_t most_segments(const LsystemParams& params, const Limits& limits);

/// Estimates the size of a model of tubes or of welded bark. The skeleton already has its widths.
Estimate estimate_of(const Skeleton& skeleton, const LsystemParams& params, Job& job);

/// Estimates the size of a model of `segments` drawn segments in `limbs` limbs, each of which becomes a tube.
Estimate estimate_of(std::uint64_t segments, std::uint64_t limbs, const LsystemParams& params);

}  // namespace seedmesh::lsystem
