#pragma once
/// The mesh of the right triangles that are left whole; for rtin.cpp.
#include <span>

#include "core/generators/terrain/rtin_halves.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Names the samples by their first use, in the order of the hierarchy. `parts` are all of the field, in
/// order; `errors` are those that a mesh of the bound `threshold` was settled with, so that no
/// sample is a corner on one side of an edge alone. Runs on job.threads().
Triangulation named(std::span<const Half> parts, const RtinErrors& errors, float threshold, const Job& job);

}  // namespace seedmesh::terrain
