#pragma once
/// Tufts, flowers and stones on the ground of leaf tiles, as copies of a few shared meshes. They are details of the ground and not
/// plants of a class: no map lists them. They stand in patches, by noise and the kind of the ground.
#include <array>

#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {

enum class CoverShape : std::uint8_t { tuft, straw, flowers, stone };
constexpr std::size_t cover_shapes = 4;

/// Bounds of the pieces in metres, in their greatest size: above the ground and below it.
constexpr double cover_height = 0.7, cover_depth = 0.11;

/// Whether tiles of a world have them: they stand on its terrain, and are sparse plants too.
bool has_ground_cover(const World& world);

/// The meshes of all shapes, one after the other. `starts`: the first corner of each, and the number of all corners.
struct CoverFile {
  PlantFile file;
  std::array<std::size_t, cover_shapes + 1> starts{};
};
CoverFile cover_file(const World& world);

/// Adds the pieces on a leaf tile. A tile has those of its own cells, so a piece is in one tile. A tile that has little room below
/// 40 KB, such as one in a village, has an even share of its pieces; add them last.
void add_ground_cover(Glb& glb, const World& world, const TileFrame& frame, const TerrainGrid& grid,
                      const TerrainMesh& terrain, Job& job);

}  // namespace seedmesh::world
