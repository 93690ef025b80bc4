#pragma once
/// Where a split cuts: the sizes of its cells worked out against the length of the scope.
///
///   fixed = sum of max(0, absolute) + sum of max(0, relative * S);  floating_i = r_i * max(0, S - fixed) /
///   sum r repeats, with Fo and fo the fixed and floating sums outside the cycle, Fi and fi inside:
///     x = (S - Fo - fo) / (Fi + fi);  nothing floats: n = ceil(x), the last one cut off at the end;
///     else n = nearest(x), at most floor((S - Fo) / Fi); each floating size times (S - Fo - n Fi) / (fo + n
///     fi)
///
/// After Müller et al. 2006 (Subdiv, formula 4.7 of Kogovšek) and the CGA reference of Esri (split).
#include <cstdint>
#include <span>
#include <vector>

#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// A cell as asked for, its number worked out. Cells of a group stand together somewhere behind the group.
struct Cell {
  double size = 0;
  Measure measure = Measure::absolute;
  bool is_group = false;
  std::uint32_t first = 0, count = 0;  ///< of a group
  std::uint32_t part = 0;              ///< what the cell is, for the caller
};

/// A piece of the scope that a cell takes.
struct Cut {
  double start = 0, size = 0;
  std::uint32_t part = 0;
};

enum class Rounding : std::uint8_t { nearest, ceil };

/// Cells [first, first + count) cut `length`. Pieces come from the low end; such of no size are left out, one
/// that reaches beyond the end is cut off, later ones do not come to be. False: there would be more than
/// `most` pieces, and `wanted` says how many; nothing is allocated for them. Cost: linear in the pieces.
bool cut(std::span<const Cell> cells, std::uint32_t first, std::uint32_t count, double length,
         Rounding rounding, double most, std::vector<Cut>& out, double& wanted);

/// Repeat("X", size): ceil or nearest of length / size equal pieces, at least one.
double copies_of(double length, double size, Rounding rounding);

}  // namespace seedmesh::building
