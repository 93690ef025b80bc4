#pragma once
/// One outline in the plane that fits it best, ready to be cut into triangles.
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/geom/limbs.h"

namespace seedmesh {

/// The points of an outline without repeated ones. Kept from outline to outline for its memory.
struct FlatOutline {
  std::vector<std::uint32_t> vertex;  ///< numbers of the outlines' vertices
  std::vector<std::uint32_t> place;   ///< of each
  std::vector<glm::dvec2> flat;       ///< of each, along u and along normal x u, from the first
  glm::dvec3 normal{0}, u{0};         ///< Newell's normal; u runs along the first edge

  /// Fills all of it in. `place` of each of the outlines' vertices: neighbours with equal places are one
  /// point. False where there are fewer than three points, or twice the area is not above `least_area`.
  bool read(const Outlines& outlines, const Outline& outline, std::span<const std::uint32_t> places,
            double least_area);

 private:
  bool flatten(const Outlines& outlines, double least_area);
};

}  // namespace seedmesh
