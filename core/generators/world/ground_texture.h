#pragma once
/// The texture of the ground of tiles of up to 2 km: a grey square that repeats. It is a file that tiles share;
/// terrain_file() has the coordinates of the vertices in it.
#include <memory>

#include "core/base/job.h"
#include "core/generators/world/shared_image.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

constexpr double widest_textured_spacing = 64;  ///< metres between samples of tiles with the texture
constexpr double ground_texture_mean = 0.84;    ///< linear; vertex colours are divided by it

constexpr float texture_repeats = 8;  ///< along the side of a tile

/// Returns the texture, which is the same for all worlds, from the store; makes it if the store has none.
std::shared_ptr<const SharedImage> ground_texture(const World& world, const Job& job);

}  // namespace seedmesh::world
