#pragma once
/// Triangles of whole steps (positions in 16 bits) that have become flat or equal.
#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Has any triangle no area? `position` in whole steps; three corners a triangle.
bool any_flat(const Column& position, std::span<const std::uint32_t> corners);

/// Triangles with an area stay, in their order.
void drop_flat(const Column& position, Array<std::uint32_t>& corners);

/// Where a thin piece has become flat, its two sides are the same triangle turned round: both go. Of
/// triangles that are there twice one stays. Only those whose hashes are equal are looked at.
void drop_folds(const Column& position, Array<std::uint32_t>& corners, Job& job);

}  // namespace seedmesh::gltf
