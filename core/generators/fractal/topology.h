#pragma once
/// The topology of a solid of cells.
#include <cstdint>
#include <optional>

#include "core/generators/fractal/lattice.h"

namespace seedmesh::fractal {

struct SolidTopology {
  std::uint64_t cells = 0;
  std::uint64_t squares = 0;             ///< faces of cells that are exposed
  std::uint64_t edges = 0, corners = 0;  ///< of the exposed squares; shared ones count once
  std::uint64_t four_face_edges = 0;  ///< edges at which two cells touch; the surface is not a manifold there
  std::uint64_t pinched_corners = 0;  ///< corners at which the surface touches itself
  /// Closed surfaces: the outsides of bodies and the walls of cavities; 0 if the surface is not a manifold.
  std::uint64_t surfaces = 0;

  /// Returns the sum of the genera of all surfaces, by Euler's formula; nullopt if the surface is not a manifold.
  std::optional<std::uint64_t> genus() const;
};

/// Counts squares, edges, four_face_edges and corners; the other members stay 0. Reads every word of the grid
/// once.
SolidTopology count_elements(const BitGrid& grid, const Job& job);

/// Counts all members. Reads every word of the grid and every corner of the surface once.
SolidTopology topology_of(const BitGrid& grid, const Job& job);

}  // namespace seedmesh::fractal
