#pragma once
/// The plants of a tile. The leaves of the tree and tiles of 128 m show whole plants. Tiles of 256 m to 1 km show
/// simple ones. Each tile shows a part of the plants that the tiles below it show. Tiles from 512 m to 4 km show the
/// surface of woods.

#include "core/generators/world/asset.h"
#include "core/generators/world/glb.h"
#include "core/generators/world/terrain_grid.h"

namespace seedmesh::world {

constexpr double widest_plants = 4096;  ///< metres; wider tiles have the colour of woods alone

/// Adds the plants of a tile.
void add_plants(Glb& glb, const World& world, const TileKey& key, const TileGround& ground, Job& job);

struct PlantFile;
/// The vertices and the material of a file of plants in a tile.
struct SharedPlants {
  Json attributes;
  int order_view = -1, material = -1;
};
/// Adds the file, with a texture of leaves.
SharedPlants add_shared_plants(Glb& glb, const PlantFile& file, const std::string& name,
                               const std::string& image);
/// Adds a mesh of `count` corners of the file from `first` on, and returns its index.
int add_plant_mesh(Glb& glb, const SharedPlants& plants, const std::string& name, std::size_t first,
                   std::size_t count);

/// Returns the model of a class from the store; makes it if the store has none. Null if the class has no model.
std::shared_ptr<const Asset> plant_asset(const World& world, int plant_class, AssetForm form, Job& job);

}  // namespace seedmesh::world
