#include "core/generators/world/glb.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/terrain_mesh.h"
#include "core/generators/world/tile_frame.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

bool has_tile(const World& world, const TileKey& key) {
  if (key.level < 0 || key.level >= world.levels) return false;
  const std::int64_t count = std::int64_t{1} << key.level;
  return key.x >= 0 && key.y >= 0 && key.x < count && key.y < count;
}

std::string tile_glb(const World& world, const TileKey& key, Job& job, std::string_view) {
  const TileFrame frame = frame_of(world, key);
  Glb glb({frame.middle_east - static_cast<double>(world.east), 0,
           -(frame.middle_north - static_cast<double>(world.north)) + 0.0});
  if (world.has(Layer::terrain)) {
    job.spend(Resource::triangles, 2 * tile_cells * tile_cells + 8 * tile_cells);
    const TerrainGrid grid = sample_grid(world, frame, tile_cells, 1, job);
    const TerrainMesh terrain = terrain_mesh(world, frame, grid, skirt_depth(world, frame));
    glb.add_mesh("terrain", terrain.mesh, glb.add_material("ground", 1), frame.step, terrain.height);
  }
  return std::move(glb).text();
}

std::optional<SharedFile> shared_file(const World&, std::string_view, Job&) { return std::nullopt; }

}  // namespace seedmesh::world
