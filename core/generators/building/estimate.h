#pragma once
/// What a building will cost, told by its shapes before any of them is made.
#include "core/generators/appraisal.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// More shapes than this are not derived for an estimate.
constexpr std::uint64_t most_appraised = 100'000;

/// Triangles of boxes and rectangles exactly, of solids by their corners, of built-in parts by making each
/// size once (where there are at most 500 sizes; else none). Bytes as shared meshes with their nodes, or
/// merged, as add_bodies will choose, with the corners that rectangles get from neighbours where they are
/// merged. Never exact: what is too thin to be drawn counts too.
std::optional<Estimate> estimate_of(const Shapes& shapes, CopyForm copies, bool shares_all, Job& job);

}  // namespace seedmesh::building
