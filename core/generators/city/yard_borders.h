#pragma once
/// Meshes of the hedges, walls and fences between the yards of a city.
#include <cstdint>
#include <vector>

#include "core/generators/city/chunks.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/surface.h"
#include "core/model/model.h"
#include "generated/params/city.h"

namespace seedmesh::city {

/// Returns the borders that the request asks for; on a terrain in short pieces, 2 cm apart, that follow the ground.
std::vector<BorderPiece> yard_borders(const Surface& surface, const CityParams& params, const Job& job);

/// The triangles of one piece: a slab, and for a fence also its posts.
std::uint64_t yard_border_triangles(const BorderPiece& piece, CityBorder kind);

/// Adds the meshes of all borders, one for each chunk. Spends Resource::triangles. No two hedges or walls share an edge.
void add_yard_borders(Model& model, ChunkNodes& nodes, const Chunks& chunks, const Surface& surface,
                      const CityParams& params, Job& job);

}  // namespace seedmesh::city
