#include "core/generators/world/water_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "core/base/math.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

using Point = glm::dvec3;  ///< east, north, height; absolute

class Builder {
 public:
  Builder(const World& world, const TileFrame& frame, double base)
      : frame_(frame), base_(base), color_(linear_color(world.params.colors.water)) {}

  /// A convex polygon, counter-clockwise from above.
  void add(const std::vector<Point>& polygon) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Point& p : polygon) mesh_.vertices.push_back(vertex_of(p));
    for (std::uint32_t k = 2; k < polygon.size(); ++k) {
      for (const std::uint32_t corner : {first, first + k - 1, first + k}) mesh_.indices.push_back(corner);
    }
  }

  void add_rectangle(double west, double south, double east, double north, double height) {
    add({{west, south, height}, {east, south, height}, {east, north, height}, {west, north, height}});
  }

  /// The part of a convex polygon that lies in the tile.
  void add_clipped(std::vector<Point> polygon) {
    for (int axis = 0; axis < 2; ++axis) {
      const double low = axis == 0 ? frame_.west : frame_.south;
      polygon = clipped(polygon, axis, low, 1);
      polygon = clipped(polygon, axis, low + frame_.side, -1);
    }
    if (polygon.size() > 2) add(polygon);
  }

  TileMesh take() { return std::move(mesh_); }

 private:
  TileVertex vertex_of(const Point& p) const {
    TileVertex vertex;
    const auto steps = [&](double metres) {
      return static_cast<std::int16_t>(math::to_int32(std::floor(metres / frame_.step + 0.5)));
    };
    vertex.x = steps(p.x - frame_.middle_east);
    vertex.y = steps_of(p.z, base_, frame_.step);
    vertex.z = steps(frame_.middle_north - p.y);
    std::copy(color_.begin(), color_.end(), vertex.color);
    return vertex;
  }

  /// Sutherland and Hodgman 1974, for one side.
  static std::vector<Point> clipped(const std::vector<Point>& polygon, int axis, double bound, double sign) {
    std::vector<Point> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
      if (da >= 0) kept.push_back(a);
      if ((da < 0) == (db < 0)) continue;
      Point cut = a + (b - a) * (da / (da - db));
      cut[axis] = bound;
      kept.push_back(cut);
    }
    return kept;
  }

  const TileFrame& frame_;
  double base_;
  std::array<std::uint8_t, 4> color_;
  TileMesh mesh_;
};

/// Rows of cells that `is_wet` accepts, as rectangles; equal neighbouring rows become one rectangle.
template <class IsWet>
void add_level(Builder& builder, const TerrainGrid& grid, double height, const IsWet& is_wet) {
  const int cells = grid.count - 1;
  struct Open {
    int first, last, row;
  };
  std::vector<Open> open;
  const auto close = [&](const Open& o, int row) {
    builder.add_rectangle(grid.west + o.first * grid.spacing, grid.south + o.row * grid.spacing,
                          grid.west + o.last * grid.spacing, grid.south + row * grid.spacing, height);
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

void add_lake(Builder& builder, const TerrainGrid& grid, const Lake& lake) {
  add_level(builder, grid, lake.level, [&](int column, int row) {
    const double east = grid.west + (column + 0.5) * grid.spacing,
                 north = grid.south + (row + 0.5) * grid.spacing;
    const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
    return away < shore_distance(lake, east, north, away) + grid.spacing &&
           is_below(grid, column, row, lake.level);
  });
}

glm::dvec2 side_of(const RiverPoint& a, const RiverPoint& b) {
  const glm::dvec2 along(b.east - a.east, b.north - a.north);
  const double length = std::sqrt(along.x * along.x + along.y * along.y);
  return length > 0 ? glm::dvec2(-along.y, along.x) / length : glm::dvec2(0, 1);
}

void add_reach(Builder& builder, const Reach& reach, double lift) {
  const RiverPoint &a = reach.from, &b = reach.to;
  const glm::dvec2 side = side_of(a, b);
  // ends overlap, so that bends have no gap
  const glm::dvec2 over = glm::dvec2(side.y, -side.x) * (0.2 * b.width);
  const glm::dvec2 p(a.east, a.north), q = glm::dvec2(b.east, b.north) + over;
  const glm::dvec2 s = side * (a.width / 2), t = side * (b.width / 2);
  builder.add_clipped({Point(p - s, a.water + lift), Point(q - t, b.water + lift),
                       Point(q + t, b.water + lift), Point(p + s, a.water + lift)});
}

}  // namespace

WaterMesh water_mesh(const World& world, const TileFrame& frame, const TerrainGrid& grid,
                     const Ground& ground, double base) {
  Builder builder(world, frame, base);
  if (world.params.relief.sea) {
    const double level = world.params.relief.sea_level;
    add_level(builder, grid, level, [&](int column, int row) { return is_below(grid, column, row, level); });
  }
  for (const Lake& lake : ground.lakes()) {
    if (lake.radius > grid.spacing) add_lake(builder, grid, lake);
  }
  for (const Reach& reach : ground.reaches()) {
    if (reach.to.width >= grid.spacing / 4) add_reach(builder, reach, std::min(2.0, 0.02 * grid.spacing));
  }
  return {builder.take(), base};
}

}  // namespace seedmesh::world
