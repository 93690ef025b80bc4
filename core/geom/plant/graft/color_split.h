#pragma once
/// Splits the bark of graft() into one mesh for each colour, as skin() returns it.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/plant/skin.h"

namespace seedmesh {

/// Returns one Bark for each colour in use, by rising colour. `colors` has the colour of each triangle. A vertex
/// on the border of two colours is in both meshes, so that the meshes are closed together. Triangles keep their
/// order. Linear time for each colour.
std::vector<Bark> split_by_color(Mesh mesh, std::span<const std::int16_t> colors, const Job& job);

/// True where the order of the triangles causes at most 1.2 misses a vertex in a small vertex cache.
bool suits_cache(const Mesh& mesh);

}  // namespace seedmesh
