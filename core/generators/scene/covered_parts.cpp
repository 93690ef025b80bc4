#include "core/generators/scene/covered_parts.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::scene {
namespace {

// The square of the radius in cells is 2. The rest is more than the rounding of positions to 32 bits.
constexpr double squared_radius = 2 * (1 - 1e-6);

/// The largest distance between two intervals of one axis.
double farthest(double first_begin, double first_end, double second_begin, double second_end) {
  return std::max(std::abs(first_end - second_begin), std::abs(second_end - first_begin));
}

/// The squares that all positions of the box with this corner cover.
CellParts parts_covered_by_box(double west, double north, double side) {
  CellParts parts = 0;
  for (int z = 0; z < parts_a_side; ++z) {
    const double dz = farthest(z / double{parts_a_side}, (z + 1) / double{parts_a_side}, north, north + side);
    for (int x = 0; x < parts_a_side; ++x) {
      const double dx = farthest(x / double{parts_a_side}, (x + 1) / double{parts_a_side}, west, west + side);
      if (dx * dx + dz * dz < squared_radius)
        parts |= CellParts{1} << static_cast<unsigned>(parts_a_side * z + x);
    }
  }
  return parts;
}

}  // namespace

CoveredParts::CoveredParts() {
  constexpr double side = 1.0 / boxes;
  for (std::size_t offset = 0; offset < cells_around.size(); ++offset) {
    const CellOffset& cell = cells_around[offset];
    for (int z = 0; z < boxes; ++z) {
      for (int x = 0; x < boxes; ++x)
        table_[row_of(offset, x, z)] = parts_covered_by_box(cell.x + side * x, cell.z + side * z, side);
    }
  }
}

const CoveredParts& covered_parts() {
  static const CoveredParts table;
  return table;
}

}  // namespace seedmesh::scene
