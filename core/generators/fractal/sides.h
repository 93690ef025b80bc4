#pragma once
/// The six sides of a solid of cells. A side is a view of a BitGrid, slice by slice; exposed() computes the
/// exposed squares of one row.
#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "core/generators/fractal/faces.h"

namespace seedmesh::fractal {

constexpr Axes axes_by_x{0, 1, 2}, axes_by_z{2, 1, 0};

/// One of the six sides: the grid from which it is read, the axis of the grid along which it faces, and the
/// world axes of the grid.
struct Side {
  const BitGrid* grid;
  Axes axes;       ///< world axis of each axis of the grid
  int slice_axis;  ///< axis of the grid along which slices follow one another, 1 or 2
  int step;        ///< direction of the normal along slice_axis, +1 or -1

  int rows() const { return grid->size()[3 - slice_axis]; }
  int slices() const { return grid->size()[slice_axis]; }
  int world_normal() const { return axes[static_cast<std::size_t>(slice_axis)]; }
  int world_rows() const { return axes[static_cast<std::size_t>(3 - slice_axis)]; }
  int world_bits() const { return axes[0]; }
  /// Returns the index of the side in SideColors.
  std::size_t number() const { return static_cast<std::size_t>(2 * world_normal() + (step > 0 ? 1 : 0)); }
  /// Returns whether bits, rows and normal are a right-handed frame.
  bool turns_right() const {
    const int bits = world_bits(), rows_axis = world_rows();
    return ((bits + 1) % 3 == rows_axis) == (step > 0);
  }

  const std::uint64_t* row(int slice, int r) const {
    return slice_axis == 2 ? grid->row(r, slice) : grid->row(slice, r);
  }
  /// Writes a row of a slice to `out`, with one bit for each exposed square.
  void exposed(int slice, int r, std::uint64_t* out) const {
    const std::size_t words = grid->row_words();
    const std::uint64_t* full = row(slice, r);
    const int beyond = slice + step;
    if (beyond < 0 || beyond >= slices()) {
      std::copy_n(full, words, out);
      return;
    }
    const std::uint64_t* cover = row(beyond, r);
    for (std::size_t w = 0; w < words; ++w) out[w] = full[w] & ~cover[w];
  }
};

/// The corners of the squares of one slice as rows of bits and, after write(), the numbers of their vertices.
class CornerRows {
 public:
  explicit CornerRows(const Side& side)
      : side_(side),
        words_(static_cast<std::size_t>(side.grid->size().x) / 64 + 1),
        rows_(static_cast<std::size_t>(side.rows()) + 1),
        bits_(words_ * rows_) {}

  void clear() { std::fill(bits_.begin(), bits_.end(), 0); }
  std::size_t words() const { return words_; }  ///< number of words of a row
  std::uint64_t* row(int r) { return bits_.data() + static_cast<std::size_t>(r) * words_; }
  const std::uint64_t* row(int r) const { return bits_.data() + static_cast<std::size_t>(r) * words_; }
  std::size_t count() const {
    std::size_t count = 0;
    for (const std::uint64_t word : bits_) count += static_cast<std::size_t>(std::popcount(word));
    return count;
  }

  /// Writes position, normal and colour of all corners, beginning with vertex `at`.
  void write(const Solid& solid, int slice, const SideColors* colors, Mesh& mesh, std::size_t at);

  /// Returns the vertex of the corner at bit 64 * w + `bit` of row `r`.
  std::uint32_t number(int r, std::size_t w, std::size_t bit) const {
    const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
    return numbers_[static_cast<std::size_t>(r) * words_ + w] +
           static_cast<std::uint32_t>(std::popcount(row(r)[w] & below));
  }

 private:
  const Side& side_;
  std::size_t words_, rows_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint32_t> numbers_;  ///< number of the first corner of each word
};

inline std::array<Side, 6> sides_of(const Solid& solid) {
  return {Side{&solid.by_z, axes_by_z, 2, -1}, Side{&solid.by_z, axes_by_z, 2, 1},
          Side{&solid.by_x, axes_by_x, 1, -1}, Side{&solid.by_x, axes_by_x, 1, 1},
          Side{&solid.by_x, axes_by_x, 2, -1}, Side{&solid.by_x, axes_by_x, 2, 1}};
}

}  // namespace seedmesh::fractal
