#include "core/generators/world/plant_layer.h"

#include <algorithm>
#include <cmath>

#include "core/generators/world/instances.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"

namespace seedmesh::world {
namespace {

constexpr int type_byte = 5120, type_unsigned_byte = 5121, type_unsigned_short = 5123, type_float = 5126;
constexpr int array_buffer = 34962, element_buffer = 34963;

constexpr int levels_of_plants = 3;       ///< above them are clumps
constexpr double widest_clumps = 8192;    ///< metres
constexpr double least_clump_height = 3;  ///< metres; lower classes are not seen from afar
constexpr double clump_width = 1.2;       ///< of a cell
constexpr double clump_reach = 0.58;      ///< of the width, from the middle of a clump

/// The share of plants that a tile shows, by the levels above the leaves.
double shown_share(int above_leaves) { return above_leaves == 0 ? 1 : above_leaves == 1 ? 0.7 : 0.4; }

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

/// Copies of the plants of a class at their places, each as high as its size by `scale`.
Instances copies_of(const std::vector<Plant>& plants, const TileFrame& frame, double share, double scale) {
  Instances copies;
  for (const Plant& plant : plants) {
    if (plant.rank >= share) continue;
    const auto size = static_cast<float>(plant.size * scale);
    copies.add({plant.east - frame.middle_east, plant.height, frame.middle_north - plant.north},
               {size, size, size});
  }
  return copies;
}

/// The scale at which a model has the height of its class and stays within the bounds of plants.
double scale_of(const WorldClass& plant, const Asset& asset) {
  const double deep = std::max(-asset.low[1], 1e-6);
  const double wide = std::max({-asset.low[0], asset.high[0], -asset.low[2], asset.high[2], 1e-6});
  return std::min({plant.height / std::max(asset.high[1], 1e-6), widest_plant * plant.height / wide,
                   deepest_root * plant.height / deep});
}

void add_places(Glb& glb, const World& world, int above_leaves, const TileFrame& frame, Job& job,
                std::string_view folder) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const Ground ground = Ground::with_works(world, box, job);
  const bool is_far = above_leaves >= 2;
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    const int number = static_cast<int>(k);
    const WorldClass& plant = world.params.plants[k];
    const std::vector<Plant> plants = plants_in(world, number, box, ground, job);
    if (plants.empty()) continue;
    const std::string name = "plants_" + plant.class_name;
    const auto asset = plant_asset(world, number, is_far ? AssetForm::far : AssetForm::near, job);
    const Instances copies =
        copies_of(plants, frame, shown_share(above_leaves), asset ? scale_of(plant, *asset) : 1);
    if (copies.count() == 0) continue;
    if (asset) {
      job.spend(Resource::triangles, copies.count() * asset->triangles);
      copies.add_to(glb, name, glb.add_asset(*asset, folder));
    } else {
      const PlantFile file = plant_file(world, number, is_far ? PlantForm::simple : PlantForm::whole);
      job.spend(Resource::triangles, copies.count() * file.indices / 3);
      copies.add_to(glb, name, {add_plant_mesh(glb, file, name, folder)});
    }
  }
}

/// The class whose woods cover a position; -1 for none.
int wood_at(const World& world, const GroundSample& sample, double east, double north) {
  int found = -1;
  double most = 0.4;
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    if (world.params.plants[k].height < least_clump_height) continue;
    const double cover = wood_cover(world, static_cast<int>(k), sample, east, north);
    if (cover <= most) continue;
    most = cover;
    found = static_cast<int>(k);
  }
  return found;
}

/// A clump in each cell of the terrain that lies in a wood. It stands on the lowest corner of its cell.
void add_clumps(Glb& glb, const World& world, const TileFrame& frame, const TerrainGrid& grid, Job& job,
                std::string_view folder) {
  std::vector<Instances> copies(world.params.plants.size());
  const double cell = grid.spacing, out = plant_extent(world).across;
  const double inset = std::max(0.0, clump_reach * clump_width * cell - out);
  for (int row = 0; row + 1 < grid.count; ++row) {
    job.check();
    for (int column = 0; column + 1 < grid.count; ++column) {
      const double west = grid.west + column * cell, south = grid.south + row * cell;
      Rng rng(cell_key(world.key ^ 0x434C554D50U, static_cast<std::int64_t>(west / cell),
                       static_cast<std::int64_t>(south / cell)));
      const double east = west + cell * rng.uniform(0.3, 0.7), north = south + cell * rng.uniform(0.3, 0.7);
      const double size = rng.uniform(0.75, 1.1), wide = clump_width * cell * rng.uniform(0.8, 1);
      const int number = wood_at(world, grid.at(column, row), east, north);
      if (number < 0) continue;
      const double corners[4] = {grid.at(column, row).height, grid.at(column + 1, row).height,
                                 grid.at(column, row + 1).height, grid.at(column + 1, row + 1).height};
      const double low = *std::min_element(corners, corners + 4);
      const double mean = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      const double high = size * world.params.plants[static_cast<std::size_t>(number)].height + mean - low;
      const double x =
          std::clamp(east, frame.west + inset, frame.west + frame.side - inset) - frame.middle_east;
      const double z =
          frame.middle_north - std::clamp(north, frame.south + inset, frame.south + frame.side - inset);
      copies[static_cast<std::size_t>(number)].add(
          {x, low, z}, {static_cast<float>(wide), static_cast<float>(high), static_cast<float>(wide)});
    }
  }
  for (std::size_t k = 0; k < copies.size(); ++k) {
    if (copies[k].count() == 0) continue;
    const std::string name = "plants_" + world.params.plants[k].class_name;
    const PlantFile file = plant_file(world, static_cast<int>(k), PlantForm::clump);
    job.spend(Resource::triangles, copies[k].count() * file.indices / 3);
    copies[k].add_to(glb, name, {add_plant_mesh(glb, file, name, folder)});
  }
}

}  // namespace

void add_plants(Glb& glb, const World& world, const TileKey& key, const TileFrame& frame,
                const TerrainGrid& grid, Job& job, std::string_view folder) {
  const int above_leaves = world.levels - 1 - key.level;
  if (above_leaves < levels_of_plants) {
    add_places(glb, world, above_leaves, frame, job, folder);
  } else if (frame.side <= widest_clumps) {
    add_clumps(glb, world, frame, grid, job, folder);
  }
}

std::shared_ptr<const Asset> plant_asset(const World& world, int plant_class, AssetForm form, Job& job) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  if (!plant.model || !world.make_asset) return nullptr;
  const Store::Key key{world.id, Store::Layer::file, plant_class, form == AssetForm::far ? 1 : 0, 0};
  return world.store->get<Asset>(key, job, [&] {
    const std::uint64_t seed = key_at(world.key, static_cast<std::uint64_t>(plant_class));
    return std::make_shared<const Asset>(
        world.make_asset(*plant.model, form, seed, "/plants/" + std::to_string(plant_class) + "/model", job));
  });
}

}  // namespace seedmesh::world
