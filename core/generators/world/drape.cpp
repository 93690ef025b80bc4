/// Flat polygons on the triangles of the terrain of a tile, so that neither covers the other.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/flat_mesh.h"

namespace seedmesh::world {
namespace {

using Polygon = std::vector<FlatMesh::Point>;

/// The part of a polygon where a * east + b * north + c is not negative. Sutherland and Hodgman 1974.
Polygon beyond(const Polygon& polygon, double a, double b, double c) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double dp = a * p.x + b * p.y + c, dq = a * q.x + b * q.y + c;
    if (dp >= 0) kept.push_back(p);
    if ((dp < 0) != (dq < 0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

/// The part between two lines of cells, with coordinates in cells.
Polygon strip(const Polygon& polygon, int axis, int from) {
  const double x = axis == 0 ? 1 : 0, y = axis == 0 ? 0 : 1;
  return beyond(beyond(polygon, x, y, -from), -x, -y, from + 1);
}

/// The first and last cell of a grid that a polygon touches.
std::pair<int, int> cells_along(const Polygon& polygon, int axis, int cells) {
  double low = 1e12, high = -1e12;
  for (const auto& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  const auto cell = [&](double v) { return math::to_int32(std::clamp(std::floor(v), -1.0, 1.0 * cells)); };
  return {std::max(0, cell(low)), std::min(cells - 1, cell(high))};
}

}  // namespace

void FlatMesh::add_draped(Polygon polygon, const TerrainGrid& grid, double lift) {
  for (Point& p : polygon) p = {(p.x - grid.west) / grid.spacing, (p.y - grid.south) / grid.spacing, 0};
  const int cells = grid.count - 1;
  const auto [first_row, last_row] = cells_along(polygon, 1, cells);
  for (int row = first_row; row <= last_row; ++row) {
    const Polygon in_row = strip(polygon, 1, row);
    if (in_row.size() < 3) continue;
    const auto [first, last] = cells_along(in_row, 0, cells);
    for (int column = first; column <= last; ++column) {
      const Polygon in_cell = strip(in_row, 0, column);
      if (in_cell.size() < 3) continue;
      const double sw = grid.at(column, row).height, se = grid.at(column + 1, row).height;
      const double nw = grid.at(column, row + 1).height, ne = grid.at(column + 1, row + 1).height;
      for (const double side : {1.0, -1.0}) {  // below and above the diagonal
        Polygon part = beyond(in_cell, side, -side, side * (row - column));
        if (part.size() < 3) continue;
        for (Point& p : part) {
          const double u = p.x - column, v = p.y - row;
          const double height =
              side > 0 ? sw + u * (se - sw) + v * (ne - se) : sw + u * (ne - nw) + v * (nw - sw);
          p = {grid.west + p.x * grid.spacing, grid.south + p.y * grid.spacing, height + lift};
        }
        add(part);
      }
    }
  }
}

}  // namespace seedmesh::world
