#pragma once
/// The order of triangles and samples of a terrain mesh for the vertex cache of a GPU.
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Reorders triangles for the vertex cache of a GPU, then renumbers samples in the order of first use. More than
/// 131,072 triangles are ordered in parts, one square tile of the field at a time, to bound the additional memory.
void order_for_cache(Triangulation& plan, const Field& field, const Job& job);

}  // namespace seedmesh::terrain
