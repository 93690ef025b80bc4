#pragma once
/// Heights of the ground at the corners of square cells, and their deviations from coarser triangles.
#include <array>
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

/// Heights at the corners of square cells. Rows run from the south, columns from the west.
struct HeightGrid {
  int samples = 0;             ///< number along a side
  double spacing = 0;          ///< metres
  double west = 0, south = 0;  ///< absolute position of sample (0, 0)
  std::vector<double> heights;

  std::size_t index_of(int i, int j) const { return static_cast<std::size_t>(j * samples + i); }
  double at(int i, int j) const { return heights[index_of(i, j)]; }
};

/// Divides the grid into `tiles` x `tiles` squares, each covered by one tile. Returns the greatest distance
/// between the samples of each square and the triangles of its tile. If a cell of a tile is as wide as the
/// spacing, no samples lie inside it. The result is then estimated from cells twice as wide. Returns an empty
/// list if cells of tiles are narrower than the spacing, or if their width is not a multiple of it.
std::vector<double> deviations_of_tiles(const HeightGrid& grid, int tiles, const Job& job);

/// Returns the greatest distance of five samples in 2 x 2 cells from two triangles over these cells: those in
/// the middles of the four sides and of the diagonal. (i, j) is the south-west corner of the cells.
double deviation_over_cells(const HeightGrid& grid, int i, int j);

/// Returns the greatest slope (rise over run) in a square of `side` x `side` cells. Its south-west corner is the
/// sample (column, row).
double greatest_slope(const HeightGrid& grid, int column, int row, int side);

/// Returns the south-west corners of the four cells in which the slope changes most, among `side` x `side`
/// cells.
std::array<std::array<int, 2>, 4> most_bent_cells(const HeightGrid& grid, int column, int row, int side);

/// Returns the distance of the ground from the triangles through its heights at the corners of a cell. It is measured
/// at the middles of the sides and of the diagonal.
double deviation_of_ground(const HeightGrid& grid, const Ground& ground, int i, int j);

/// Heights before valleys are cut, and ruggedness, at the samples of a grid. It does not own them.
struct UncutLand {
  const std::vector<double>& heights;
  const std::vector<float>& ruggedness;
};

/// The distances in metres up to which a valley is cut: `wide` into all land, `farthest` into land above `least`.
struct ValleyWidth {
  double wide = 0, farthest = 0, least = 0;
};
/// Lowers samples to the valley of a stretch of a river, up to `width.farthest` from its bounding box.
void carve(HeightGrid& grid, const UncutLand& land, const Reach& reach, const ValleyWidth& width);
/// Lowers samples to the valley and the bed of a lake.
void carve(HeightGrid& grid, const UncutLand& land, const Lake& lake);

}  // namespace seedmesh::world
