#pragma once
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Puts triangles into an order that a vertex cache likes, and samples into the order of their first use.
/// More than 131,072 triangles in parts, by squares of the field, so that beside them it needs little room.
void order_for_cache(Triangulation& plan, const Field& field, const Job& job);

}  // namespace seedmesh::terrain
