#pragma once
/// An outline in the plane that fits it best, ready for triangulation.
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/geom/plant/limbs.h"

namespace seedmesh {

/// The points of an outline without repeated ones. Reuse one object for many outlines to avoid allocations.
struct FlatOutline {
  std::vector<std::uint32_t> vertex;  ///< vertex numbers of Outlines
  std::vector<std::uint32_t> number;  ///< position number of each point
  std::vector<glm::dvec2> flat;  ///< coordinates of each point along u and normal x u, relative to the first
  glm::dvec3 normal{0}, u{0};    ///< Newell's normal; u runs along the first edge

  /// Reads an outline. `numbers`: the position number of each vertex; neighbours with equal numbers are one
  /// point. Returns false where there are fewer than three points, or where twice the area is at most
  /// `least_area`.
  bool read(const Outlines& outlines, const Outline& outline, std::span<const std::uint32_t> numbers,
            double least_area);

 private:
  bool flatten(const Outlines& outlines, double least_area);
};

}  // namespace seedmesh
