#pragma once
/// Builds the mesh of the triangles that stay whole; internal to rtin.cpp.
#include <span>

#include "core/generators/terrain/rtin_triangles.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Numbers the samples by their first use, in the order of the hierarchy. `parts` are all parts of the field,
/// in order. `errors` must give a conforming mesh for the bound `threshold`: each sample on an edge is a
/// corner on both sides of the edge, or on none. Runs on job.threads().
Triangulation named(std::span<const RtinTriangle> parts, const RtinErrors& errors, float threshold,
                    const Job& job);

}  // namespace seedmesh::terrain
