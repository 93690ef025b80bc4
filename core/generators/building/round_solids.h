#pragma once
/// Closed solids of revolution, and a disk, with a number of sides. All fill the unit cube as far as their corners reach.
#include <cstdint>
#include <glm/vec2.hpp>

#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// A regular polygon, seen from above.
struct RoundForm {
  std::uint32_t sides = 3;
  double first = 0;        ///< degrees of the first corner, from +x towards -z
  bool is_smooth = false;  ///< whether the faces around the axis have smooth normals
};

/// Returns a corner of the polygon in the unit square: x and z.
glm::dvec2 corner_of(const RoundForm& form, std::uint32_t i);

Solid disk_of(const RoundForm& form);
Solid cylinder_of(const RoundForm& form);
Solid cone_of(const RoundForm& form);
/// A sphere is always smooth. `rows`: bands from pole to pole, at least 2.
Solid sphere_of(const RoundForm& form, std::uint32_t rows);

}  // namespace seedmesh::building
