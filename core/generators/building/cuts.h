#pragma once
/// The positions where a split cuts a scope, from the sizes of its cells.
///
///   fixed      = sum of max(0, absolute) + sum of max(0, relative * S)
///   floating_i = r_i * max(0, S - fixed) / sum of all r
///
/// A repeated group has n copies. Fo and fo are the fixed and floating sums outside of it, Fi and fi inside:
///   x = (S - Fo - fo) / (Fi + fi)
///   nothing floats: n = ceil(x), and the last copy is cut off at the end
///   else:           n = nearest(x), at most floor((S - Fo) / Fi)
///   each floating size is multiplied by (S - Fo - n Fi) / (fo + n fi)
///
/// After Müller et al. 2006 (Subdiv, formula 4.7 of Kogovšek) and the CGA reference of Esri (split).
#include <cstdint>
#include <span>
#include <vector>

#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// A cell with its evaluated size. A group refers to a range of cells that follow it in the array.
struct Cell {
  double size = 0;
  Measure measure = Measure::absolute;
  bool is_group = false;
  std::uint32_t first = 0, count = 0;  ///< range of the cells of a group
  std::uint32_t part = 0;              ///< identifier of the cell, for the caller
};

/// A piece of the scope. Its start is measured from the low end of the scope, in the unit of `length`.
struct Cut {
  double start = 0, size = 0;
  std::uint32_t part = 0;
};

enum class Rounding : std::uint8_t { nearest, ceil };

struct CutOptions {
  Rounding rounding = Rounding::nearest;
  double most = 0;  ///< greatest number of pieces
};

/// Cuts `length` into the first `count` cells; the others belong to groups. Pieces come in order from the low end.
/// Pieces without a size are left out, and the piece that reaches beyond the end is cut off there. Returns false if
/// there would be more than options.most pieces; `wanted` is then their number. Cost: linear in the pieces.
bool cut(std::span<const Cell> cells, std::uint32_t count, double length, const CutOptions& options,
         std::vector<Cut>& out, double& wanted);

/// Returns the number of equal pieces of Repeat("X", size): length / size rounded up or to the nearest, at least 1.
double copies_of(double length, double size, Rounding rounding);

}  // namespace seedmesh::building
