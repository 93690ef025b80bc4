#pragma once
/// Heights of the ground at the corners of square cells, and their distances from coarser triangles; used by areas.cpp.
#include <array>
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

/// Heights at the corners of square cells. Rows run from the south, columns from the west.
struct HeightGrid {
  int wide = 0;                ///< samples along a side
  double spacing = 0;          ///< metres
  double west = 0, south = 0;  ///< absolute position of sample (0, 0)
  std::vector<double> heights;

  std::size_t index_of(int i, int j) const { return static_cast<std::size_t>(j * wide + i); }
  double at(int i, int j) const { return heights[index_of(i, j)]; }
};

/// Returns, for each of `tiles` x `tiles` squares, the greatest distance of its samples from the triangles of a
/// tile there. If the cells of the tiles are those of the grid, returns an estimate of the deviation between
/// samples. Empty if the cells are smaller or their sides are not multiples of the spacing.
std::vector<double> deviations_of_tiles(const HeightGrid& grid, int tiles, const Job& job);

/// Returns how far five samples are from triangles through every other sample. (i, j) is the south-west corner of
/// 2 x 2 cells.
double deviation_from_next(const HeightGrid& grid, int i, int j);

/// Returns the greatest slope in a square of `side` x `side` cells.
double greatest_slope(const HeightGrid& grid, int column, int row, int side);

/// Returns the south-west corners of the cells of a square of `side` x `side` cells in which the heights bend most.
std::array<std::array<int, 2>, 4> most_bent_cells(const HeightGrid& grid, int column, int row, int side);

/// Returns how far the ground is from the triangles between its heights at the corners of a cell.
double deviation_of_ground(const HeightGrid& grid, const Ground& ground, int i, int j);

/// Land and ruggedness at the samples of a grid. It does not own them.
struct UncutLand {
  const std::vector<double>& heights;
  const std::vector<float>& ruggedness;
};

/// Lowers samples of the land to the valley of a river, which extends `wide` metres.
void carve(HeightGrid& grid, const UncutLand& land, const Reach& reach, double wide);
/// Lowers samples of the land to the valley and the bed of a lake.
void carve(HeightGrid& grid, const UncutLand& land, const Lake& lake);

}  // namespace seedmesh::world
