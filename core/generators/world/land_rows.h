#pragma once
/// The land at positions in a row, for bounds. It agrees with land_at() to about a millimetre, and has no slopes.
/// Positions of a row lie in few cells of each lattice of noise, so a row takes a sixth of the time of single
/// positions.
#include <array>
#include <vector>

#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

/// Positions at equal distances along a parallel, in absolute metres.
struct RowOfPositions {
  double west = 0, north = 0, spacing = 0;
  std::size_t count = 0;
};

/// Members of Land for each position of a row.
struct LandRow {
  std::vector<float> height, ruggedness, coast;
  std::array<std::vector<float>, range_octaves> ridges;
};

/// Computes the land of a row into `land`, whose arrays are reused.
void land_of_row(const World& world, const RowOfPositions& row, LandRow& land);

}  // namespace seedmesh::world
