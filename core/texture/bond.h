#pragma once
/// Patterns of equal pieces in rows, such as bricks, tiles and boards. They are computed one row of texels at a time.
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/rng.h"

namespace seedmesh::texture {

/// Rows and columns of equal pieces; every other row is shifted by `shift` of a piece.
struct Bond {
  int columns = 8, rows = 24;
  float shift = 0.5F;
  glm::dvec2 tile{1};  ///< width and height that the whole image covers, metres
};

/// The pieces under each texel of an image of `size` texels.
class Courses {
 public:
  Courses(const Bond& bond, int size);

  /// A row of texels. `x` and `y` are positions in a piece, from 0 to 1, y down. `to_side` and `to_bed` are the distances
  /// to the nearest vertical and horizontal border of the piece, in metres.
  struct Row {
    int row;
    float y, to_bed;
    const float *x, *to_side;
    const int* column;
  };
  Row row(int y) const;

  const Bond& bond() const { return bond_; }

 private:
  struct Along {
    std::vector<float> x, to_side;
    std::vector<int> column;
  };
  Bond bond_;
  int size_;
  Along even_, odd_;
};

/// A random number from 0 to 1 of each piece, by its position.
class PieceNumbers {
 public:
  PieceNumbers(const Bond& bond, Rng rng);
  /// Returns the number of the piece in this column.
  float at(const Courses::Row& row, int column) const {
    return numbers_[static_cast<std::size_t>(row.row * columns_ + column)];
  }

 private:
  int columns_;
  std::vector<float> numbers_;
};

}  // namespace seedmesh::texture
