#include "core/generators/world/plant_layer.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/world/canopy.h"
#include "core/generators/world/instances.h"
#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"

namespace seedmesh::world {
namespace {

constexpr int type_byte = 5120, type_unsigned_byte = 5121, type_unsigned_short = 5123, type_float = 5126;
constexpr int array_buffer = 34962, element_buffer = 34963;

/// What tiles of a level show of the plants.
struct Showing {
  double share =
      1;  ///< of marks, of classes whose crowns close; about 0.7 and 0.4 of the plants at 0.25 and 0.08
  double open_share = 1;  ///< share of other classes
  double width = 1;       ///< fewer plants are wider, so that they cover as much
  bool is_simple = false, has_canopy = false;
};
/// By the levels above the leaves. Higher levels have the canopy alone.
constexpr Showing showings[] = {{1, 1, 1, false, false},
                                {0.25, 0.3, 1.2, false, false},
                                {0.08, 0.12, 1.35, true, false},
                                {0.018, 0.05, 1.45, true, true},
                                {0, 0.012, 1.3, true, true}};
constexpr int levels_of_plants = 5;
constexpr double widest_open = 1.3;     ///< the most that classes whose crowns do not close are widened
constexpr double least_far_height = 3;  ///< metres; lower classes are not seen from afar
constexpr int first_far_level = 3;      ///< number of the level above the leaves

/// A tint that makes plants of a class differ: darker or lighter, yellower or bluer.
std::array<std::uint8_t, 4> tint_of(Rng& rng) {
  const double light = rng.uniform(0.68, 0.96), hue = rng.uniform(-0.06, 0.06);
  const auto byte = [](double v) {
    return static_cast<std::uint8_t>(math::to_int32(std::min(v, 1.0) * 255));
  };
  return {byte(light * (1 + hue)), byte(light), byte(light * (1 - hue)), 255};
}

/// Copies of the plants of a class at their places, each as high as its size by `scale`.
Instances copies_of(const std::vector<Plant>& plants, const TileFrame& frame, double scale, double width,
                    bool is_tinted) {
  Instances copies;
  for (const Plant& plant : plants) {
    Rng rng(plant.key);
    const double size = plant.size * scale;
    const auto high = static_cast<float>(size),
               wide = static_cast<float>(size * width * rng.uniform(0.88, 1.1));
    copies.add({plant.east - frame.middle_east, plant.height, frame.middle_north - plant.north},
               {is_tinted ? wide : high, high, is_tinted ? wide : high});
    if (is_tinted) copies.tint(tint_of(rng));
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

void add_places(Glb& glb, const World& world, int above_leaves, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const Ground ground = Ground::with_works(world, box, job);
  const Showing& showing = showings[above_leaves];
  const bool is_far = showing.is_simple;
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    const int number = static_cast<int>(k);
    const WorldClass& plant = world.params.plants[k];
    if (above_leaves >= first_far_level && plant.height < least_far_height) continue;
    const bool closes = has_canopy(plant);
    if ((closes ? showing.share : showing.open_share) <= 0) continue;
    const std::vector<Plant> plants =
        plants_in(world, number, box, ground, job, {closes ? showing.share : showing.open_share});
    if (plants.empty()) continue;
    const std::string name = "plants_" + plant.class_name;
    const auto asset = plant_asset(world, number, is_far ? AssetForm::far : AssetForm::near, job);
    const double width = closes ? showing.width : std::min(showing.width, widest_open);
    const Instances copies = copies_of(plants, frame, asset ? scale_of(plant, *asset) : 1, width, !asset);
    if (asset) {
      job.spend(Resource::triangles, copies.count() * asset->triangles);
      copies.add_to(glb, name, glb.add_asset(*asset));
    } else {
      const PlantFile file = plant_file(world, number, is_far ? PlantForm::simple : PlantForm::whole);
      job.spend(Resource::triangles, copies.count() * file.indices / 3);
      const std::string image = shared_files + leaf_texture(world, job)->hash + ".png";
      copies.add_to(glb, name,
                    {add_plant_mesh(glb, add_shared_plants(glb, file, name, image), name, 0, file.indices)});
    }
  }
}

}  // namespace

void add_plants(Glb& glb, const World& world, const TileKey& key, const TileGround& ground, Job& job) {
  const TileFrame frame = frame_of(world, key);
  const int above_leaves = world.levels - 1 - key.level;
  const bool has_places = above_leaves < levels_of_plants;
  if (has_places) add_places(glb, world, above_leaves, frame, job);
  if (has_places ? showings[above_leaves].has_canopy : frame.side <= widest_plants)
    add_canopy(glb, world, frame, ground, job);
}

SharedPlants add_shared_plants(Glb& glb, const PlantFile& file, const std::string& name,
                               const std::string& image) {
  const int buffer = glb.add_shared_buffer(file.hash + ".bin", file.bytes.size());
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
  attributes["TEXCOORD_0"] = glb.add_accessor({{"bufferView", vertices},
                                               {"byteOffset", 20},
                                               {"componentType", type_unsigned_short},
                                               {"normalized", true},
                                               {"count", file.vertices},
                                               {"type", "VEC2"}});
  return {std::move(attributes), order, glb.add_leaf_material(name, image)};
}

int add_plant_mesh(Glb& glb, const SharedPlants& plants, const std::string& name, std::size_t first,
                   std::size_t count) {
  Json order = {{"bufferView", plants.order_view},
                {"componentType", type_unsigned_short},
                {"count", count},
                {"type", "SCALAR"}};
  if (first > 0) order["byteOffset"] = 2 * first;
  const int indices = glb.add_accessor(std::move(order));
  return glb.add_gltf_mesh({{"name", name},
                            {"primitives", Json::array({{{"attributes", plants.attributes},
                                                         {"indices", indices},
                                                         {"material", plants.material}}})}});
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
