#pragma once
/// The order of triangles and samples of a terrain mesh for the vertex cache of a GPU.
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Reorders triangles for the vertex cache of a GPU, then renumbers samples in the order of first use. More than
/// 131,072 triangles are processed in parts, by squares of the field, to bound the additional memory.
void order_for_cache(Triangulation& plan, const Field& field, const Job& job);

}  // namespace seedmesh::terrain
