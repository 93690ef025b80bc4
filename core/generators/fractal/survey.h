#pragma once
/// The topology of a solid of cells, counted.
#include <cstdint>
#include <optional>

#include "core/generators/fractal/lattice.h"

namespace seedmesh::fractal {

struct Survey {
  std::uint64_t cells = 0;
  std::uint64_t squares = 0;             ///< exposed
  std::uint64_t edges = 0, corners = 0;  ///< of the surface, each place counted once
  std::uint64_t four_face_edges = 0;     ///< where two cells touch along an edge only: no manifold there
  std::uint64_t pinched_corners = 0;     ///< where the surface touches itself in a point
  std::uint64_t surfaces = 0;            ///< closed surfaces: outsides of bodies and walls of hollows

  /// Of all surfaces together, by Euler's formula; nullopt where the surface is no manifold.
  std::optional<std::uint64_t> genus() const;
};

/// Squares, edges and corners alone: one look at every word of the grid.
Survey skeleton_of(const BitGrid& grid, const Job& job);

/// Looks at every word of the grid and at every corner of the surface once.
Survey survey_of(const BitGrid& grid, const Job& job);

}  // namespace seedmesh::fractal
