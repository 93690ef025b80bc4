#pragma once
/// The mesh of a class of plants, in a file that all tiles share.
#include <string>

#include "core/generators/world/world.h"

namespace seedmesh::world {

struct PlantFile {
  std::string hash;  ///< 16 hexadecimal digits of the content
  std::string
      bytes;  ///< vertices of 20 bytes (position as floats, normal as bytes, linear colour), then indices
  std::uint32_t vertices = 0, indices = 0;  ///< indices have 16 bits
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  std::uint64_t bytes_of_store() const { return bytes.size() + sizeof(PlantFile); }
};

constexpr std::size_t plant_vertex_bytes = 20;

/// whole: for leaves and the level above. simple: for tiles of 256 m and more.
enum class PlantForm { whole, simple };

/// The plant at its mean height, its foot at the origin, +Y up. Below 200 triangles.
PlantFile plant_file(const World& world, int plant_class, PlantForm form = PlantForm::whole);

/// The width of the crown of a plant of mean height, in metres.
double crown_width(const WorldClass& plant);

constexpr double plant_depth = 0.1;    ///< metres that the foot of a plant is below the ground
constexpr double deepest_root = 0.06;  ///< of the height: how far a plant may reach below its foot
constexpr double widest_plant = 0.8;   ///< of the height: how far a plant may reach from its foot in plan

/// The greatest distance of a part of a plant from its foot, in plan, upwards and below the ground, over all copies of all classes.
struct PlantExtent {
  double across = 0, up = 0, down = 0;
};
PlantExtent plant_extent(const World& world);

/// The same for classes of at most this height, in metres.
PlantExtent plant_extent(double height);

}  // namespace seedmesh::world
