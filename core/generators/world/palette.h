#pragma once
/// Colours of the ground by climate, height and slope.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/generators/world/ground.h"
#include "core/generators/world/ground_texture.h"

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

/// The linear colour of the ground at a position, and the kind of which it has most.
struct GroundLook {
  std::array<std::uint8_t, 4> color{};
  GroundKind kind = GroundKind::grass;
};

/// The form of the ground around a sample.
struct GroundForm {
  double steepness = 1;     ///< cosine of the slope
  double hollow = 0;        ///< mean height of the samples around it above it, by their distance
  double spacing = 2;       ///< metres between samples; variations over less are left out
  bool is_textured = true;  ///< whether a texture multiplies the colour
};

/// Returns the look of the ground at [east, north]. Hollows are darker and crests lighter. The ground of the deep sea has the colour of
/// the water, because skirts can be visible through the water: the depth values of skirts that are seen edge-on have
/// little precision.
GroundLook ground_look(const World& world, const GroundColors& colors, const GroundSample& sample,
                       const glm::dvec2& at, const GroundForm& form);
/// Returns the colour of the sea at [east, north], `depth` metres above its bed: pale over shallow sand, dark where it is
/// deep. Variations over less than `spacing` metres are left out.
std::array<std::uint8_t, 4> sea_color(const World& world, const GroundColors& colors, double depth,
                                      const glm::dvec2& at, double spacing);
/// Returns a colour of the request as linear bytes, opaque.
std::array<std::uint8_t, 4> linear_color(const Color& color);

}  // namespace seedmesh::world
