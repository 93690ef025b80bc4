#pragma once
/// Built-in models of street furniture and trees, made of closed bodies. Metres, +Y up; the front faces +Z, the
/// foot is at height 0, and parts in the ground have negative heights.
#include <string_view>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::city {

/// Returns the number of built-in models of a kind: "lamps", "trees", "park_trees", "yard_trees", "benches",
/// "bins", "signs" and "cars". Returns 1 for other names.
std::uint32_t built_in_count(std::string_view kind);

/// Returns the model with the index `number` of a kind: one node with one mesh of 12 to 220 triangles. Spends
/// Resource::triangles.
Model built_in_model(std::string_view kind, std::uint32_t number, Job& job);

}  // namespace seedmesh::city
