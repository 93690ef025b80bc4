#pragma once
/// The terrain of a tile as a quantized mesh.
#include "core/generators/world/error_model.h"
#include "core/generators/world/glb.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/terrain_grid.h"

namespace seedmesh::world {

struct TerrainMesh {
  std::vector<TileVertex> vertices;
  std::vector<GroundKind> kinds;  ///< of the vertices
  double height = 0;              ///< metres at position 0: a multiple of the step
};

/// Returns a vertex for each sample of the tile, and below those of the border a skirt whose walls face outwards;
/// terrain_indices() has the triangles. `grid` has a halo. Heights are rounded to whole steps of the level, and
/// normals follow from samples of the level. Neighbours of one level therefore have equal borders.
TerrainMesh terrain_mesh(const World& world, const TileFrame& frame, const TerrainGrid& grid, double skirt);

/// Returns the depth in metres of the skirt of a tile of a level. It hides gaps beside tiles of up to three levels
/// coarser or finer. `grid` is that of the tile.
double skirt_depth(const World& world, int level, const TerrainGrid& grid);
/// Returns a bound of the depths of skirts in an area; 0 where tiles do not show the terrain.
double most_skirt(const World& world, const TileFrame& frame, Roughness roughness);

/// Returns `height` minus `base` in whole steps, within 16 bits.
std::int16_t steps_of(double height, double base, double step);
/// Returns a multiple of the step near the middle of a range of heights.
double base_of(double low, double high, double step);

}  // namespace seedmesh::world
