#pragma once
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Reorders triangles for the vertex cache, and samples by their first use. More than 131,072 triangles are
/// processed in parts, by squares of the field, to bound the additional memory.
void order_for_cache(Triangulation& plan, const Field& field, const Job& job);

}  // namespace seedmesh::terrain
