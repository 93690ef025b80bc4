#pragma once
/// Textures of the ground of tiles of up to 8 km: squares in near grey that repeat, one for each kind of ground in small
/// tiles, and one for all land in wide ones. They are files that tiles share; terrain_file() has the coordinates of the
/// vertices in them.
#include <array>
#include <memory>

#include "core/base/job.h"
#include "core/generators/world/shared_image.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

enum class GroundKind : std::uint8_t { grass, soil, rock, sand, snow, land };
constexpr std::size_t ground_kinds = 6;

constexpr double widest_textured_spacing = 128;  ///< metres between samples of tiles with a texture
constexpr double widest_kind_spacing = 8;     ///< the same, of tiles with a texture for each kind of ground
constexpr double ground_texture_mean = 0.75;  ///< linear; vertex colours are divided by it

/// A tile has the images turned: along its side, this many repeat in the direction of u, and across it.
constexpr int texture_repeats_along = 8, texture_repeats_across = 3;

/// Returns the mean of a texture, linear. Snow is lighter than the others, because vertex colours are at most 1.
constexpr double mean_of(GroundKind kind) { return kind == GroundKind::snow ? 0.9 : ground_texture_mean; }

/// Returns a texture, which is the same for all worlds, from the store; makes it if the store has none.
std::shared_ptr<const SharedImage> ground_texture(const World& world, GroundKind kind, const Job& job);

}  // namespace seedmesh::world
