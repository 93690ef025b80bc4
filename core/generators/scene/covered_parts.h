#pragma once
/// The parts of a grid cell that lie inside the exclusion disc of a position in a neighbouring cell. The
/// radius of the disc is the diagonal of a cell.
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace seedmesh::scene {

/// A cell by its distance from another one, in cells.
struct CellOffset {
  int x, z;
};
/// The cells whose positions can be nearer than the radius to a position in the centre cell, nearest first.
constexpr std::array<CellOffset, 20> cells_around{
    {{-1, 0}, {1, 0}, {0, -1},  {0, 1},  {-1, -1}, {1, -1}, {-1, 1},  {1, 1},  {-2, 0}, {2, 0},
     {0, -2}, {0, 2}, {-2, -1}, {-2, 1}, {2, -1},  {2, 1},  {-1, -2}, {1, -2}, {-1, 2}, {1, 2}}};

/// A set of the 8 x 8 equal squares of a cell. Square (x, z) is bit 8 z + x.
using CellParts = std::uint64_t;
constexpr int parts_a_side = 8;
constexpr CellParts all_parts = ~CellParts{0};

/// Table of the squares of the centre cell that lie completely inside the disc around a position in a neighbouring
/// cell.
class CoveredParts {
 public:
  CoveredParts();

  /// Returns the covered squares. `offset` is the index of the neighbouring cell in cells_around. `at` is the position
  /// inside that cell as (x, z), each from 0 to 1; values outside are clamped. The position is rounded to a
  /// box of 1/16 of a cell. Only squares that every position of the box covers are returned, so squares at
  /// the edge of the disc can be missing.
  CellParts of(std::size_t offset, const glm::vec2& at) const {
    return table_[row_of(offset, box_of(at.x), box_of(at.y))];
  }

 private:
  static constexpr int boxes = 16;  // along each side of a cell
  static std::size_t row_of(std::size_t offset, int box_x, int box_z) {
    return (offset * boxes + static_cast<std::size_t>(box_z)) * boxes + static_cast<std::size_t>(box_x);
  }
  static int box_of(float share) { return std::clamp(static_cast<int>(share * boxes), 0, boxes - 1); }

  std::array<CellParts, cells_around.size() * boxes * boxes> table_{};
};

/// Returns the table that all callers share. It is computed on first use; any thread may call this.
const CoveredParts& covered_parts();

}  // namespace seedmesh::scene
