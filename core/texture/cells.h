#pragma once
/// Cells around scattered points, row by row, for textures.
///
/// After Worley, "A Cellular Texture Basis Function", 1996, with one point in each lattice square.
#include <vector>

#include "core/base/rng.h"
#include "core/texture/field.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {

/// The jittered points of a periodic lattice.
class Cells {
 public:
  Cells(int size, Lattice lattice, Rng rng);

  /// A point and the random number of its cell.
  struct Point {
    float x, y, shade;
  };
  /// Returns the points of the lattice, in units of lattice squares, with copies beyond all four sides.
  const std::vector<Point>& points() const { return points_; }

 private:
  friend class CellRows;
  int size_;
  Lattice lattice_;
  int pitch_;  ///< points of a row with those that repeat on both sides
  std::vector<Point> points_;
};

/// Rows of cells, made one at a time: for each texel the distance to the border of its cell and the random number of
/// its cell, from 0 to 1. The distance is in lattice squares: 0 on the border, about 0.5 in the middle. `wobble`
/// displaces the lookup by `strength` lattice squares. Keeps references. Cost: about 3 ns a texel.
class CellRows {
 public:
  CellRows(const Cells& cells, const Field& wobble, float strength);

  struct Row {
    const float *border, *shade;
  };
  /// Returns the values of a row, until the next call.
  Row row(int y);

 private:
  const Cells& cells_;
  const Field& wobble_;
  float strength_;
  std::vector<float> x_, y_, border_, shade_;
};

}  // namespace seedmesh::texture
