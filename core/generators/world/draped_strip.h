#pragma once
/// A strip along a line on the triangles of the terrain of a tile, for rivers that are narrow compared with the
/// cells.
#include <vector>

#include "core/generators/world/flat_mesh.h"
#include "core/generators/world/region.h"

namespace seedmesh::world {

/// The left and the right edge of a strip at a point of its line. Heights are not used.
struct StripEdges {
  FlatMesh::Point left{}, right{};
};

/// Adds the strip between two points, `lift` metres above the triangles of the terrain along its line and along its
/// edges. It has vertices where it would otherwise leave this height by more than a share of `lift`. It also has
/// vertices at the borders of the tile, so that strips of neighbouring tiles meet. The strip is clipped to the tile.
/// Its edges may lie at most one cell outside of the tile.
void add_draped_strip(FlatMesh& builder, const TerrainGrid& grid, const StripEdges& from,
                      const StripEdges& to, double lift);

/// Returns the line without points that are within `tolerance` metres of the rest. The ends stay. Douglas and
/// Peucker 1973.
std::vector<RiverPoint> simplified_line(const std::vector<RiverPoint>& points, double tolerance);

}  // namespace seedmesh::world
