#pragma once
/// Morph targets between levels of detail.
#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {

/// Fills Mesh::next_position of every visible mesh of a node with levels: the position of each vertex on the next
/// coarser level that differs.
/// - Sheets such as leaves keep their texture coordinates: a vertex goes to the point of the same leaf with the same
///   coordinates. A leaf that the next level lacks shrinks to one of its vertices, near its stalk.
/// - All other vertices go to the nearest point of the surface.
/// - Vertices keep their position on the last level, before an impostor, and where the next level hides the node.
/// Call it after finish(). Time: n log n, about 2 microseconds for each vertex outside of sheets.
void add_next_positions(Model& model, const Job& job);

}  // namespace seedmesh
