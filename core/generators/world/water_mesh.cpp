#include "core/generators/world/water_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/generators/world/flat_mesh.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/river_mesh.h"

namespace seedmesh::world {
namespace {

constexpr double overlap = 1.0 / 8;          ///< share of a cell, at the borders of sheets
constexpr double widest_lake_spacing = 256;  ///< metres between samples that show the shores of lakes
constexpr double lake_reach = 100;           ///< metres

/// Cells of the grid: from the first column and row to those after the last.
struct Cells {
  int west, south, east, north;
};

/// Sheets of a lake overlap inside the tile: their corners need not meet those of their neighbours, and without an
/// overlap single pixels of the ground below would show.
void add_sheet(FlatMesh& builder, const TerrainGrid& grid, const Cells& cells, double height) {
  const double out = overlap * grid.spacing, side = (grid.count - 1) * grid.spacing;
  const auto at = [&](double from, int cell, double by) {
    return std::clamp(from + cell * grid.spacing + by, from, from + side);
  };
  builder.add_rectangle(at(grid.west, cells.west, -out), at(grid.south, cells.south, -out),
                        at(grid.west, cells.east, out), at(grid.south, cells.north, out), height);
}

/// Rows of cells that `is_wet` accepts, as rectangles; equal neighbouring rows become one rectangle.
template <class IsWet>
void add_level(FlatMesh& builder, const TerrainGrid& grid, double height, const IsWet& is_wet) {
  const int cells = grid.count - 1;
  struct Open {
    int first, last, row;
  };
  std::vector<Open> open;
  const auto close = [&](const Open& o, int row) {
    add_sheet(builder, grid, {o.first, o.row, o.last, row}, height);
  };
  for (int row = 0; row <= cells; ++row) {
    std::vector<Open> here;
    for (int column = 0; row < cells && column < cells; ++column) {
      if (!is_wet(column, row)) continue;
      int last = column + 1;
      while (last < cells && is_wet(last, row)) ++last;
      here.push_back({column, last, row});
      column = last;
    }
    for (const Open& o : open) {
      const auto same = std::find_if(here.begin(), here.end(),
                                     [&](const Open& h) { return h.first == o.first && h.last == o.last; });
      if (same != here.end()) {
        same->row = o.row;
      } else {
        close(o, row);
      }
    }
    open = std::move(here);
  }
}

bool is_below(const TerrainGrid& grid, int column, int row, double level) {
  return std::min(std::min(grid.at(column, row).height, grid.at(column + 1, row).height),
                  std::min(grid.at(column, row + 1).height, grid.at(column + 1, row + 1).height)) < level;
}

/// The sea in squares of cells, where ground is below it; the ground hides it where it is dry.
void add_sea(FlatMesh& builder, const World& world, const TerrainGrid& grid, Job& job) {
  constexpr int squares = 16;
  const double level = world.params.relief.sea_level;
  const int cells = grid.count - 1, step = std::max(1, cells / squares);
  const GroundColors colors(world);
  const auto place = [&](int column, int row) {
    return glm::dvec2(grid.west + column * grid.spacing, grid.south + row * grid.spacing);
  };
  const auto color = [&](int column, int row) {
    return sea_color(world, colors, level - grid.at(column, row).height, place(column, row),
                     step * grid.spacing);
  };
  for (int row = 0; row < cells; row += step) {
    job.check();
    for (int column = 0; column < cells; column += step) {
      bool is_wet = false;
      for (int k = 0; k <= step * (step + 2) && !is_wet; ++k)
        is_wet = grid.at(column + k % (step + 1), row + k / (step + 1)).height < level;
      if (!is_wet) continue;
      builder.add_rectangle(place(column, row), place(column + step, row + step), level,
                            {color(column, row), color(column + step, row), color(column + step, row + step),
                             color(column, row + step)});
    }
  }
  builder.set_color(linear_color(world.params.colors.water));
}

void add_lake(FlatMesh& builder, const TerrainGrid& grid, const Lake& lake) {
  add_level(builder, grid, lake.level, [&](int column, int row) {
    const double east = grid.west + (column + 0.5) * grid.spacing,
                 north = grid.south + (row + 0.5) * grid.spacing;
    const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
    return away < shore_distance(lake, east, north, away) + grid.spacing &&
           is_below(grid, column, row, lake.level);
  });
}

}  // namespace

WaterMesh water_of(const World& world, const TileFrame& frame, const TileGround& tile, Job& job) {
  const TerrainGrid& grid = tile.grid;
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  FlatMesh builder(frame, tile.base, linear_color(world.params.colors.water));
  if (world.params.relief.sea) add_sea(builder, world, grid, job);
  if (grid.spacing <= widest_lake_spacing) {
    const Ground ground(world, box, job, lake_reach);
    for (const Lake& lake : ground.lakes()) {
      if (is_wide_lake(lake, grid.spacing)) add_lake(builder, grid, lake);
    }
  }
  if (grid.spacing < dry_spacing) add_rivers(builder, world, frame, grid, job);
  return {builder.take(), tile.base};
}

}  // namespace seedmesh::world
