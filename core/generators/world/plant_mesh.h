#pragma once
/// The mesh of a class of plants, in a file that all tiles share.
#include <string>
#include <vector>

#include "core/generators/world/world.h"

namespace seedmesh::world {

struct PlantFile {
  std::string hash;  ///< 16 hexadecimal digits of the content
  /// Vertices of 24 bytes (position as floats, normal as signed bytes, linear colour as RGBA bytes, coordinates in
  /// leaf_texture() as 16-bit integers), then indices, padded to a multiple of 4 bytes.
  std::string bytes;
  std::uint32_t vertices = 0, indices = 0;  ///< indices have 16 bits
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
};

constexpr std::size_t plant_vertex_bytes = 24;

/// `whole` is for leaf tiles of the quadtree and the level above them, `simple` for tiles of 256 m and more.
enum class PlantForm { whole, simple };

/// Makes the plant at its mean height, with its foot at the origin and +Y up. It has fewer than 330 triangles.
PlantFile plant_file(const World& world, int plant_class, PlantForm form = PlantForm::whole);

/// Returns the width of the crown of a plant of mean height, in metres.
double crown_width(const WorldClass& plant);

constexpr double plant_depth = 0.1;    ///< metres that the foot of a plant is below the ground
constexpr double deepest_root = 0.06;  ///< greatest reach of a plant below its foot, as a share of its height
/// Greatest reach of a plant from its foot in plan, as a share of its height.
constexpr double widest_plant = 0.8;

/// Upper bounds of the distance of any part of a plant from its foot in plan, and below the ground, in metres.
struct PlantExtent {
  double across = 0, down = 0;
};
/// Returns the bounds for all plants of a world; 0 without plants. `across` is rounded up to whole metres.
PlantExtent plant_extent(const World& world);

/// Returns the bounds for classes of at most this height, in metres.
PlantExtent plant_extent(double height);

/// Returns for each class how far its tallest plants reach above the ground, in metres. Makes the meshes of classes
/// without a model.
std::vector<double> plant_tops(const World& world);

}  // namespace seedmesh::world
