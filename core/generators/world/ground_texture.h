#pragma once
/// The texture of the ground of tiles of up to 2 km: a grey square that repeats, and the coordinates of the vertices in
/// it, which are the same in all tiles. Both are files that tiles share.
#include <memory>
#include <string>

#include "core/base/job.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

constexpr double widest_textured_spacing = 64;  ///< metres between samples of tiles with the texture
constexpr double ground_texture_mean = 0.84;    ///< linear; vertex colours are divided by it

struct GroundTexture {
  /// Pairs of floats, little-endian, for each vertex with the skirt.
  std::string coordinates_hash, coordinates;
  std::string image_hash, image;  ///< a PNG file
  std::uint64_t bytes() const { return sizeof(GroundTexture) + coordinates.size() + image.size(); }
};

/// Returns the texture, which is the same for all worlds, from the store; makes it if the store has none.
std::shared_ptr<const GroundTexture> ground_texture(const World& world, const Job& job);

}  // namespace seedmesh::world
