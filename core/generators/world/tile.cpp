#include <algorithm>

#include "core/generators/world/error_model.h"
#include "core/generators/world/flat_mesh.h"
#include "core/generators/world/glb.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/terrain_mesh.h"
#include "core/generators/world/tile_frame.h"
#include "core/generators/world/water_mesh.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr int type_byte = 5120, type_unsigned_byte = 5121, type_unsigned_short = 5123, type_float = 5126;
constexpr int array_buffer = 34962, element_buffer = 34963;

/// Ribbons narrower than a pixel of a coarse tile are not drawn, so such tiles need no rivers.
constexpr double widest_river_spacing = 512;  ///< metres between samples

constexpr double widest_road_spacing = 16, widest_house_spacing = 16;

/// The share of plants that a tile shows: all in leaves, fewer in the two levels above.
double shown_share(const World& world, int level) {
  switch (world.levels - 1 - level) {
    case 0:
      return 1;
    case 1:
      return 0.7;
    case 2:
      return 0.35;
    default:
      return 0;
  }
}

struct Copies {
  std::vector<float> translations, scales;
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
};

Copies copies_of(const std::vector<Plant>& plants, const TileFrame& frame, double share) {
  Copies copies;
  for (const Plant& plant : plants) {
    if (plant.rank >= share) continue;
    const float at[3] = {static_cast<float>(plant.east - frame.middle_east), static_cast<float>(plant.height),
                         static_cast<float>(frame.middle_north - plant.north) + 0.0F};
    const bool is_first = copies.translations.empty();
    for (int k = 0; k < 3; ++k) {
      copies.low[k] = is_first ? at[k] : std::min(copies.low[k], at[k]);
      copies.high[k] = is_first ? at[k] : std::max(copies.high[k], at[k]);
      copies.translations.push_back(at[k]);
      copies.scales.push_back(static_cast<float>(plant.size));
    }
  }
  return copies;
}

int add_plant_mesh(Glb& glb, const PlantFile& file, const std::string& name, std::string_view folder) {
  const int buffer =
      glb.add_shared_buffer(std::string(folder) + "a/" + file.hash + ".bin", file.bytes.size());
  const std::size_t size = file.vertices * plant_vertex_bytes;
  const int vertices = glb.add_view(buffer, 0, size, plant_vertex_bytes, array_buffer);
  const int order = glb.add_view(buffer, size, file.indices * 2, 0, element_buffer);
  Json attributes;
  attributes["POSITION"] = glb.add_accessor({{"bufferView", vertices},
                                             {"componentType", type_float},
                                             {"count", file.vertices},
                                             {"type", "VEC3"},
                                             {"min", file.low},
                                             {"max", file.high}});
  attributes["NORMAL"] = glb.add_accessor({{"bufferView", vertices},
                                           {"byteOffset", 12},
                                           {"componentType", type_byte},
                                           {"normalized", true},
                                           {"count", file.vertices},
                                           {"type", "VEC3"}});
  attributes["COLOR_0"] = glb.add_accessor({{"bufferView", vertices},
                                            {"byteOffset", 16},
                                            {"componentType", type_unsigned_byte},
                                            {"normalized", true},
                                            {"count", file.vertices},
                                            {"type", "VEC4"}});
  const int indices = glb.add_accessor({{"bufferView", order},
                                        {"componentType", type_unsigned_short},
                                        {"count", file.indices},
                                        {"type", "SCALAR"}});
  const int material = glb.add_material(name, 1);
  return glb.add_gltf_mesh(
      {{"name", name},
       {"primitives",
        Json::array({{{"attributes", attributes}, {"indices", indices}, {"material", material}}})}});
}

void add_plants(Glb& glb, const World& world, const TileKey& key, const TileFrame& frame, Job& job,
                std::string_view folder) {
  const double share = shown_share(world, key.level);
  if (share <= 0) return;
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const Ground ground = Ground::with_works(world, box, job);
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    const Copies copies = copies_of(plants_in(world, static_cast<int>(k), box, ground, job), frame, share);
    const std::size_t count = copies.translations.size() / 3;
    if (count == 0) continue;
    const PlantFile file = plant_file(world, static_cast<int>(k));
    job.spend(Resource::triangles, count * file.indices / 3);
    glb.use_extension("EXT_mesh_gpu_instancing");
    const auto add = [&](const std::vector<float>& values) {
      const int view = glb.add_bytes(values.data(), values.size() * sizeof(float), 0, 0);
      return Json{{"bufferView", view}, {"componentType", type_float}, {"count", count}, {"type", "VEC3"}};
    };
    Json translation = add(copies.translations);
    translation["min"] = copies.low;
    translation["max"] = copies.high;
    const int at = glb.add_accessor(std::move(translation)), scale = glb.add_accessor(add(copies.scales));
    const std::string name = "plants_" + world.params.plants[k].class_name;
    glb.add_node(
        {{"name", name},
         {"mesh", add_plant_mesh(glb, file, name, folder)},
         {"extensions",
          {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", at}, {"SCALE", scale}}}}}}}});
  }
}

void add_mesh(Glb& glb, std::string_view name, const TileMesh& mesh, double roughness, const TileFrame& frame,
              double base, Job& job) {
  if (mesh.indices.empty()) return;
  job.spend(Resource::triangles, mesh.indices.size() / 3);
  glb.add_mesh(name, mesh, glb.add_material(name, roughness), frame.step, base);
}

void add_water(Glb& glb, const World& world, const TileFrame& frame, const TerrainGrid& grid, double base,
               Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const bool is_coarse = grid.spacing > widest_river_spacing;
  const Ground ground = is_coarse ? Ground(world) : Ground(world, box, job, 100);
  const WaterMesh water = water_mesh(world, frame, grid, ground, base);
  add_mesh(glb, "water", water.mesh, 0.15, frame, base, job);
}

/// Roads and houses of small tiles.
void add_works(Glb& glb, const World& world, const TileFrame& frame, double base, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  if (frame.spacing <= widest_road_spacing && world.has(Layer::roads)) {
    FlatMesh roads(frame, base, linear_color(world.params.roads.color));
    const double lift = 0.1 + 0.03 * frame.spacing;
    for (const auto& road : roads_near(world, box, world.params.roads.width, job)) {
      for (std::size_t k = 1; k < road->points.size(); ++k) {
        const RoadPoint &a = road->points[k - 1], &b = road->points[k];
        roads.add_ribbon({a.east, a.north, a.height + lift}, road->width, {b.east, b.north, b.height + lift},
                         road->width);
      }
    }
    add_mesh(glb, "roads", roads.take(), 0.95, frame, base, job);
  }
  if (frame.spacing <= widest_house_spacing && world.has(Layer::buildings)) {
    add_mesh(glb, "buildings", house_mesh(world, frame, houses_near(world, box, 0, job), base), 0.9, frame,
             base, job);
  }
}

}  // namespace

bool has_tile(const World& world, const TileKey& key) {
  if (key.level < 0 || key.level >= world.levels) return false;
  const std::int64_t count = std::int64_t{1} << key.level;
  return key.x >= 0 && key.y >= 0 && key.x < count && key.y < count;
}

std::string tile_glb(const World& world, const TileKey& key, Job& job, std::string_view folder) {
  const TileFrame frame = frame_of(world, key);
  Glb glb({frame.middle_east - static_cast<double>(world.east), 0.0,
           0.0 - (frame.middle_north - static_cast<double>(world.north))});
  const TerrainGrid grid = sample_grid(world, frame, tile_cells, 1, job);
  const TerrainMesh terrain = terrain_mesh(world, frame, grid, skirt_depth(world, frame.side));
  if (world.has(Layer::terrain)) {
    job.spend(Resource::triangles, terrain.mesh.indices.size() / 3);
    glb.add_mesh("terrain", terrain.mesh, glb.add_material("ground", 1), frame.step, terrain.height);
  }
  if (world.has(Layer::water)) add_water(glb, world, frame, grid, terrain.height, job);
  add_works(glb, world, frame, terrain.height, job);
  if (world.has(Layer::plants)) add_plants(glb, world, key, frame, job, folder);
  return std::move(glb).text();
}

std::optional<SharedFile> shared_file(const World& world, std::string_view hash, Job&) {
  for (std::size_t k = 0; world.has(Layer::plants) && k < world.params.plants.size(); ++k) {
    PlantFile file = plant_file(world, static_cast<int>(k));
    if (file.hash == hash) return SharedFile{std::move(file.bytes), "application/octet-stream", "bin"};
  }
  return std::nullopt;
}

}  // namespace seedmesh::world
