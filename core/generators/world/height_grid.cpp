#include "core/generators/world/height_grid.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/areas.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {
namespace {

/// The deviation from cells by that from cells twice as wide: a quarter where the ground is smooth between its samples,
/// a half at crests. Where samples are farther apart than crests, or have gullies, it is more.
constexpr double next_share = 0.6, smooth_next_share = 0.5;

/// The greatest distance of samples from the two triangles of a cell of a tile, whose south-west corner is a sample.
double deviation_in_cell(const HeightGrid& grid, int i, int j, int stride) {
  const double sw = grid.at(i, j), se = grid.at(i + stride, j), nw = grid.at(i, j + stride),
               ne = grid.at(i + stride, j + stride);
  double most = 0;
  for (int y = 0; y <= stride; ++y) {
    for (int x = 0; x <= stride; ++x) {
      const double plane =
          x >= y ? stride * sw + x * (se - sw) + y * (ne - se) : stride * sw + x * (ne - nw) + y * (nw - sw);
      most = std::max(most, std::abs(grid.at(i + x, j + y) - plane / stride));
    }
  }
  const double steep = std::max(std::abs(ne - sw), std::abs(se - nw)) / (2.83 * stride * grid.spacing);
  return most / std::sqrt(1 + steep * steep);
}

/// Calls `visit` with the samples within `reach` of a rectangle and with their positions.
template <class Visit>
void for_samples(const HeightGrid& grid, const Rectangle& r, double reach, const Visit& visit) {
  const double last = grid.samples - 1;
  const auto index = [&](double v) {
    return math::to_int32(std::clamp(std::floor(v / grid.spacing), -1.0, last));
  };
  const int west = index(r.west - reach - grid.west) + 1, east = index(r.east + reach - grid.west);
  const int south = index(r.south - reach - grid.south) + 1, north = index(r.north + reach - grid.south);
  for (int j = south; j <= north; ++j) {
    for (int i = west; i <= east; ++i)
      visit(grid.index_of(i, j), grid.west + i * grid.spacing, grid.south + j * grid.spacing);
  }
}

}  // namespace

std::vector<double> deviations_of_tiles(const HeightGrid& grid, int tiles, const Job& job) {
  const int wide = (grid.samples - 1) / tiles, cells = cells_of(wide * grid.spacing), stride = wide / cells;
  std::vector<double> found;
  if (stride < 1 || wide % cells != 0) return found;
  // without samples inside of cells, by those inside of cells twice as wide
  const int wider = std::max(stride, 2), count = wide / wider;
  const double share = stride >= 2 ? 1 : grid.spacing == coarse_spacing ? smooth_next_share : next_share;
  found.reserve(static_cast<std::size_t>(tiles) * static_cast<std::size_t>(tiles));
  for (int row = 0; row < tiles; ++row) {
    job.check();
    for (int column = 0; column < tiles; ++column) {
      double most = 0;
      for (int k = 0; k < count * count; ++k) {
        const int i = column * wide + k % count * wider, j = row * wide + k / count * wider;
        most = std::max(most, deviation_in_cell(grid, i, j, wider));
      }
      found.push_back(share * most);
    }
  }
  return found;
}

double deviation_over_cells(const HeightGrid& grid, int i, int j) {
  const double sw = grid.at(i, j), se = grid.at(i + 2, j), nw = grid.at(i, j + 2), ne = grid.at(i + 2, j + 2);
  const double off = std::max(
      {std::abs(grid.at(i + 1, j) - (sw + se) / 2), std::abs(grid.at(i, j + 1) - (sw + nw) / 2),
       std::abs(grid.at(i + 1, j + 1) - (sw + ne) / 2), std::abs(grid.at(i + 2, j + 1) - (se + ne) / 2),
       std::abs(grid.at(i + 1, j + 2) - (nw + ne) / 2)});
  const double steep = std::max(std::abs(ne - sw), std::abs(se - nw)) / (2 * 2.83 * grid.spacing);
  return off / std::sqrt(1 + steep * steep);
}

double greatest_slope(const HeightGrid& grid, int column, int row, int side) {
  double most = 0;
  for (int j = row; j < row + side; ++j) {
    for (int i = column; i < column + side; ++i) {
      const double here = grid.at(i, j), east = grid.at(i + 1, j) - here, north = grid.at(i, j + 1) - here;
      most = std::max(most, east * east + north * north);
    }
  }
  return std::sqrt(most) / grid.spacing;
}

std::array<std::array<int, 2>, 4> most_bent_cells(const HeightGrid& grid, int column, int row, int side) {
  std::array<std::array<int, 2>, 4> cells{};
  cells.fill({column, row});
  std::array<double, 4> bends{};
  const int first_row = std::max(row, 1), end_row = std::min(row + side, grid.samples - 2);
  const int first = std::max(column, 1), end = std::min(column + side, grid.samples - 2);
  for (int j = first_row; j < end_row; ++j) {
    for (int i = first; i < end; ++i) {
      const double here = grid.at(i, j);
      const double bend = std::abs(grid.at(i, j - 1) - here - grid.at(i, j + 1) + grid.at(i, j + 2)) +
                          std::abs(grid.at(i - 1, j) - here - grid.at(i + 1, j) + grid.at(i + 2, j));
      std::size_t place = 0;
      while (place < bends.size() && bends[place] >= bend) ++place;
      if (place == bends.size()) continue;
      for (std::size_t k = bends.size() - 1; k > place; --k) {
        bends[k] = bends[k - 1];
        cells[k] = cells[k - 1];
      }
      bends[place] = bend;
      cells[place] = {i, j};
    }
  }
  return cells;
}

double deviation_of_ground(const HeightGrid& grid, const Ground& ground, int i, int j) {
  HeightGrid cell{3, grid.spacing / 2, grid.west + i * grid.spacing, grid.south + j * grid.spacing, {}};
  cell.heights.reserve(9);
  for (int k = 0; k < 9; ++k) {
    const int row = k / 3, column = k % 3;
    cell.heights.push_back(ground.height(cell.west + column * cell.spacing, cell.south + row * cell.spacing));
  }
  return deviation_over_cells(cell, 0, 0);
}

void carve(HeightGrid& grid, const UncutLand& land, const Reach& reach, const ValleyWidth& width) {
  const RiverPoint &a = reach.from, &b = reach.to;
  const Rectangle around{std::min(a.east, b.east), std::min(a.north, b.north), std::max(a.east, b.east),
                         std::max(a.north, b.north)};
  const double wide_square = width.wide * width.wide;
  for_samples(grid, around, width.farthest, [&](std::size_t n, double east, double north) {
    const double uncut = land.heights[n];
    const double x = east - a.east, y = north - a.north;
    const double share = std::clamp((x * reach.x + y * reach.y) * reach.by, 0.0, 1.0);
    const double dx = x - share * reach.x, dy = y - share * reach.y, square = dx * dx + dy * dy;
    if (square >= valley_reach * valley_reach || (uncut <= width.least && square > wide_square)) return;
    const WatersidePoint waterside{std::sqrt(square), (a.width + share * (b.width - a.width)) / 2,
                                   a.water + share * (b.water - a.water)};
    const double ruggedness = static_cast<double>(land.ruggedness[n]);
    if (is_above(grid.heights[n], uncut, ruggedness, waterside)) return;
    grid.heights[n] = std::min(grid.heights[n], valley_side(uncut, ruggedness, waterside).height);
  });
}

void carve(HeightGrid& grid, const UncutLand& land, const Lake& lake) {
  const double far = 1.3 * lake.radius;
  const Rectangle around{lake.east - far, lake.north - far, lake.east + far, lake.north + far};
  for_samples(grid, around, valley_reach, [&](std::size_t n, double east, double north) {
    const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
    const double shore = shore_distance(lake, east, north, away), t = away / shore;
    const WatersidePoint waterside{away - shore, 5, lake.level};
    const double height =
        t < 1 ? lake.level - lake.depth * (1 - t * t)
              : valley_side(land.heights[n], static_cast<double>(land.ruggedness[n]), waterside).height;
    grid.heights[n] = std::min(grid.heights[n], height);
  });
}

}  // namespace seedmesh::world
