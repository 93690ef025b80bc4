#pragma once
/// Rivers and small lakes of a tile. Where samples are too far apart for the bed of a river, its ribbon lies on the
/// terrain. The ribbon is wide enough to be visible, so that rivers are continuous from every distance.
#include "core/generators/world/flat_mesh.h"
#include "core/generators/world/ground.h"

namespace seedmesh::world {

/// Returns the least width of the ribbon of a large river, for a tile with this spacing of samples. Such a tile is seen
/// from a distance that grows with the spacing, even by clients with a small error limit.
constexpr double least_ribbon(double spacing) { return spacing * (0.016 + 0.5 * spacing / (spacing + 300)); }

/// Returns the height in metres of draped water above the terrain.
constexpr double drape_lift(double spacing) { return 0.02 * spacing; }

/// Adds the rivers of a tile, and lakes that are too small for its samples.
void add_rivers(FlatMesh& builder, const World& world, const TileFrame& frame, const TerrainGrid& grid,
                Job& job);

/// Whether samples with this spacing show the shore of a lake.
bool is_wide_lake(const Lake& lake, double spacing);

}  // namespace seedmesh::world
