#pragma once
/// Colours of the ground by climate, height and slope.
#include <array>
#include <cstdint>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

/// Linear colour of the ground. `steepness` is the cosine of the slope. Where samples are `spacing` metres apart,
/// variations that lie between them are left out.
std::array<std::uint8_t, 4> ground_color(const World& world, const GroundSample& sample, double east,
                                         double north, double steepness, double spacing);
std::array<std::uint8_t, 4> linear_color(const Color& color);

}  // namespace seedmesh::world
