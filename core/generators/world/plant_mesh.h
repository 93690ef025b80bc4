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

/// The plant at its mean height, its foot at the origin, +Y up. Below 200 triangles.
PlantFile plant_file(const World& world, int plant_class);

/// The greatest distance of a part of a plant from its foot, in plan and upwards, over all copies of all classes.
struct PlantExtent {
  double across = 0, up = 0;
};
PlantExtent plant_extent(const World& world);

}  // namespace seedmesh::world
