#pragma once
/// Colours of the ground by climate, height and slope.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

struct Shade {
  double red = 0, green = 0, blue = 0;
};

/// The colours of the ground of a world, linear. Make it once for a tile.
struct GroundColors {
  explicit GroundColors(const World& world);
  Shade dry, grass, forest, rock, sand, snow, water;
  std::vector<Shade> fields;
};

/// Returns the linear colour of the ground at [east, north]. `steepness` is the cosine of the slope. Variations over less than
/// `spacing`, the metres between samples, are left out. The ground of the deep sea has the colour of the water,
/// because skirts can be visible through the water: the depth values of skirts that are seen edge-on have little
/// precision.
std::array<std::uint8_t, 4> ground_color(const World& world, const GroundColors& colors,
                                         const GroundSample& sample, const glm::dvec2& at, double steepness,
                                         double spacing);
/// Returns a colour of the request as linear bytes, opaque.
std::array<std::uint8_t, 4> linear_color(const Color& color);

}  // namespace seedmesh::world
