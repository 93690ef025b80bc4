#pragma once
/// Estimates of the bytes of terrains.
#include <cstdint>

#include "core/generators/api.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {

constexpr std::uint64_t bytes_a_vertex = 36;  ///< position, normal, texture coordinates, colour
/// Of a vertex of ground with details: the texture coordinates of its grounds, and the tangent.
constexpr std::uint64_t bytes_of_coordinates = 8, bytes_of_tangent = 16;
constexpr std::uint64_t document_bytes = 1200;  ///< of the JSON, without the origin of the model

/// Returns the bytes of the file of a grid with a number of triangles, with its levels of detail. The classes of ground with
/// details, and the vertices that several classes have, are those of a small version of the field without erosion by
/// water. Cost: about 5 ms with details.
std::uint64_t bytes_of_grid(const TerrainParams& params, std::uint64_t triangles,
                            const GenerateContext& context);

}  // namespace seedmesh::terrain
