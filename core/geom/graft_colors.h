#pragma once
/// The bark of graft(), colour by colour, as skin() gives it.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/skin.h"

namespace seedmesh {

/// One Bark for each colour in use, rising; `colors` of each triangle. Vertices on a border come twice, so
/// that the meshes are closed together. Triangles keep their order. Linear time for each colour.
std::vector<Bark> parted_by_color(Mesh mesh, std::span<const std::int16_t> colors, const Job& job);

/// Do its triangles come in an order for which a small vertex cache misses at most 1.2 times a vertex?
bool suits_cache(const Mesh& mesh);

}  // namespace seedmesh
