#pragma once
/// BitGrid -> Mesh: the squares between a full cell and an empty one.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/generators/fractal/lattice.h"
#include "core/model/mesh.h"

namespace seedmesh::fractal {

/// A grid in two orientations, since rows of bits give four of the six sides: bits along X (x, y, z), and
/// bits along Z (z, y, x).
struct Solid {
  BitGrid by_x, by_z;
  glm::dvec3 origin;  ///< the lower corner of the cell that both grids hold first
  glm::dvec3 cell;
};

Solid solid_of(const Lattice& lattice, int rounds, const Job& job);

/// Colours of the sides -X, +X, -Y, +Y, -Z, +Z.
using SideColors = std::array<glm::u8vec4, 6>;

/// How many squares can be seen. One look at each word of the grid.
std::uint64_t count_exposed(const Solid& solid, const Job& job);

/// Every exposed square as two triangles; squares of one plane that face alike share their corners. Closed;
/// where cells touch only along an edge four triangles meet there. In cache order (bands of eight squares).
/// Spends triangles first; slices are made in parallel, each at a place that was counted before.
Mesh exposed_faces(const Solid& solid, const SideColors* colors, Job& job);

}  // namespace seedmesh::fractal
