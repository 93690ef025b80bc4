#pragma once
/// Converts a solid to a mesh, with a square between each full cell and each of its empty neighbours.
#include <array>
#include <cstdint>

#include "core/generators/fractal/lattice.h"
#include "core/model/mesh.h"

namespace seedmesh::fractal {

/// Two copies of a grid: bits along X with the axes (x, y, z), and bits along Z with the axes (z, y, x). Rows
/// are compared word by word with neighbouring rows, which gives four of the six sides. The sides -X and +X
/// are read from the second copy.
struct Solid {
  BitGrid by_x, by_z;
  glm::dvec3 origin;  ///< the lower corner of the first cell of both grids
  glm::dvec3 cell;
};

Solid solid_of(const Lattice& lattice, int rounds, const Job& job);

/// Colours of the sides -X, +X, -Y, +Y, -Z, +Z.
using SideColors = std::array<glm::u8vec4, 6>;

/// Returns the number of exposed squares. Reads each word of the grid once.
std::uint64_t count_exposed(const Solid& solid, const Job& job);

/// Returns every exposed square as two triangles. Squares of one plane that face the same way share vertices.
/// The mesh is closed; where cells touch only along an edge, four squares meet. Triangles are ordered for the
/// vertex cache, in bands eight squares wide. Spends Resource::triangles first. Slices are made in parallel.
Mesh exposed_faces(const Solid& solid, const SideColors* colors, Job& job);

}  // namespace seedmesh::fractal
