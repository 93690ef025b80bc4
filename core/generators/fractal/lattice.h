#pragma once
/// Maps that all divide by the same whole number and translate by whole cells. With cubes they fill cells of
/// a lattice, which a grid stores with one bit for each cell.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/base/array.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

struct Lattice {
  int parts = 3;  ///< a block is divided into parts^3 smaller ones
  std::vector<glm::ivec3>
      cells;               ///< first cells of the copies; with blocks of one cell, 0 .. parts-1 are inside
  glm::ivec3 block{1};     ///< cells of the element along X, Y, Z; 2 where copies are offset by half a copy
  glm::dvec3 fraction{0};  ///< translation of all cells by a part of a cell
  bool keeps = false;      ///< Instructions::keeps

  bool inside() const;            ///< whether every copy is in the block, in a cell of its own
  double side(int rounds) const;  ///< cells along the edge of the unit element: parts^rounds
};

/// Returns the lattice that the maps fill, or nullopt if they fill none.
std::optional<Lattice> lattice_of(const Instructions& instructions);

/// A box of cells with one bit each. Axis 0 is the one along which bits are stored.
class BitGrid {
 public:
  BitGrid(const Job& job, glm::ivec3 low, glm::ivec3 size);

  glm::ivec3 low() const { return low_; }  ///< corner of the first cell, in cells of the last round
  glm::ivec3 size() const { return size_; }
  std::size_t row_words() const { return words_; }
  std::uint64_t* row(int y, int z) { return bits_.data() + offset(y, z); }
  const std::uint64_t* row(int y, int z) const { return bits_.data() + offset(y, z); }
  bool at(int x, int y, int z) const { return (row(y, z)[x / 64] >> (x % 64) & 1) != 0; }
  std::uint64_t count() const;

  /// Sets every cell that is set in `other` translated by `move`.
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

/// The world axis of each axis of a grid.
using Axes = std::array<int, 3>;

/// Returns the cells after `rounds` rounds. Each round joins translated copies of the one before, so the cost is
/// about that of writing the grid once. Throws Stop for a grid of more than 2^20 cells along a side. Charges
/// the grid to the memory budget.
BitGrid grid_of(const Lattice& lattice, int rounds, const Axes& axes, const Job& job);

/// The lower corner of cell 0, and the edges of a cell, in the frame of the unit element.
struct Placement {
  glm::dvec3 origin;
  glm::dvec3 cell;
};
Placement placement_of(const Lattice& lattice, int rounds);

}  // namespace seedmesh::fractal
