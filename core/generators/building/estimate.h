#pragma once
/// The size of the output of a building, estimated from its shapes before meshes are made.
#include "core/generators/api.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// More shapes than this are not derived for an estimate.
constexpr std::uint64_t most_appraised = 100'000;

/// Triangles and bytes of the shapes. Triangles of boxes and rectangles are exact, those of solids follow
/// from their corners, and built-in parts are made once for each size; none if there are more than 500 sizes.
/// Bytes count shared meshes with their nodes, or merged meshes, as add_bodies chooses. Shapes that are too
/// thin to be drawn count as well, so that the estimate may be too high.
std::optional<Estimate> estimate_of(const Shapes& shapes, CopyForm copies, bool shares_all, Job& job);

}  // namespace seedmesh::building
