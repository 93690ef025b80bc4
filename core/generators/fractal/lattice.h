#pragma once
/// Copy machines whose maps all shrink by the same whole number and only move, by whole cells: with cubes
/// they fill cells of a lattice, which a grid of bits holds at one bit a cell.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/base/array.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

struct Lattice {
  int parts = 3;  ///< a block is divided into parts * parts * parts smaller ones
  std::vector<glm::ivec3>
      cells;               ///< first cells of the copies; with blocks of one cell, 0 .. parts-1 lie inside
  glm::ivec3 block{1};     ///< cells of the element along X, Y, Z: 2 where copies stand between others
  glm::dvec3 fraction{0};  ///< all cells are moved by so much of a cell
  bool keeps = false;

  bool inside() const;            ///< every copy lies in the block, in a cell of its own
  double side(int rounds) const;  ///< cells along the edge of the unit element: parts^rounds
};

/// Nullopt where the maps are no such machine.
std::optional<Lattice> lattice_of(const Instructions& instructions);

/// A box of cells, one bit each. Axes are numbered from the one along which bits lie.
class BitGrid {
 public:
  BitGrid(const Job& job, glm::ivec3 low, glm::ivec3 size);

  glm::ivec3 low() const { return low_; }  ///< of the first cell, in cells of the last round
  glm::ivec3 size() const { return size_; }
  std::size_t row_words() const { return words_; }
  std::uint64_t* row(int y, int z) { return bits_.data() + offset(y, z); }
  const std::uint64_t* row(int y, int z) const { return bits_.data() + offset(y, z); }
  bool at(int x, int y, int z) const { return (row(y, z)[x / 64] >> (x % 64) & 1) != 0; }
  std::uint64_t count() const;

  /// Sets every bit that is set in `other`, moved so that both grids mean the same cells.
  void add(const BitGrid& other, glm::ivec3 move, const Job& job);
  void fill_block(glm::ivec3 from, glm::ivec3 sides);

 private:
  std::size_t offset(int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(y)) *
           words_;
  }

  glm::ivec3 low_, size_;
  std::size_t words_;
  Array<std::uint64_t> bits_;
};

/// The axes of the world along the axes of a grid.
using Axes = std::array<int, 3>;

/// The cells after so many rounds. Each round joins moved copies of the round before, so the cost is about
/// that of writing the grid once. Refuses (Stop) a grid beyond 2^20 cells a side; memory is charged.
BitGrid grid_of(const Lattice& lattice, int rounds, const Axes& axes, const Job& job);

/// Where the lower corner of the grid's cell 0 lies in the frame of the unit element, and a cell's edge.
struct Placement {
  glm::dvec3 origin;
  glm::dvec3 cell;
};
Placement placement_of(const Lattice& lattice, int rounds);

}  // namespace seedmesh::fractal
