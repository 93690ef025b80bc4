#pragma once
/// Triangles that quantization has made flat or equal. Positions are quantized (16 bits).
#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Whether any triangle has no area. `corners`: three for each triangle.
bool has_flat_triangle(const Column& position, std::span<const std::uint32_t> corners);

/// Removes triangles without area; the others keep their order.
void drop_flat_triangles(const Column& position, Array<std::uint32_t>& corners);

/// Removes duplicate triangles. Where a thin piece has become flat, its two sides are the same triangle with
/// opposite windings, and both are removed. Of triangles with equal winding, one is kept. Cost: O(n log n) in
/// the number of triangles.
void drop_doubled_triangles(const Column& position, Array<std::uint32_t>& corners, Job& job);

}  // namespace seedmesh::gltf
