#include "core/generators/world/river_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/draped_strip.h"

namespace seedmesh::world {
namespace {

constexpr double least_width = 1.0 / 96;  ///< share of the spacing; narrower rivers are left out
constexpr double least_lake = 1.0 / 4;    ///< radius as a share of the spacing
constexpr double resolved_width = 1.5, resolved_lake = 3;  ///< by the spacing
constexpr double strip_width = 0.35;                 ///< share of the spacing; wider ribbons are cut by cells
constexpr double bend_tolerance = 0.1;               ///< share of the spacing, for the lines of rivers
constexpr double great_river = 18;                   ///< metres; narrower ones have narrower ribbons
constexpr int least_corners = 8, most_corners = 24;  ///< corners of lakes

/// A ribbon whose pieces share their corners, as triangles.
class Ribbon {
 public:
  Ribbon(FlatMesh& builder, const TerrainGrid& grid) : builder_(builder), grid_(grid) {}

  void add(const std::vector<RiverPoint>& points, const Rectangle& box) {
    const double least = least_ribbon(grid_.spacing);
    for (std::size_t k = 1; k < points.size(); ++k) {
      const RiverPoint &a = points[k - 1], &b = points[k];
      const double reach = std::max({a.width, b.width, least});
      if (b.width < least_width * grid_.spacing || std::min(a.east, b.east) > box.east + reach ||
          std::max(a.east, b.east) < box.west - reach || std::min(a.north, b.north) > box.north + reach ||
          std::max(a.north, b.north) < box.south - reach) {
        continue;
      }
      const StripEdges from = edges(points, k - 1, least), to = edges(points, k, least);
      if (std::max(a.width, b.width) < strip_width * grid_.spacing) {
        add_draped_strip(builder_, grid_, from, to, drape_lift(grid_.spacing));
        continue;
      }
      const bool is_draped = b.width < resolved_width * grid_.spacing;
      add_triangle({from.right, to.right, to.left}, is_draped);
      add_triangle({from.right, to.left, from.left}, is_draped);
    }
  }

 private:
  using Point = FlatMesh::Point;

  /// The left and the right edge at a point.
  static StripEdges edges(const std::vector<RiverPoint>& points, std::size_t k, double least) {
    const RiverPoint &p = points[k], &before = points[k == 0 ? 0 : k - 1],
                     &after = points[std::min(k + 1, points.size() - 1)];
    const double x = after.east - before.east, y = after.north - before.north;
    const double length = std::max(1e-6, std::sqrt(x * x + y * y));
    const double half = std::max(p.width, least * std::clamp(std::sqrt(p.width / great_river), 0.5, 1.0)) / 2;
    const Point middle(p.east, p.north, p.water), out(-half * y / length, half * x / length, 0);
    return {middle + out, middle - out};
  }

  void add_triangle(std::vector<Point> corners, bool is_draped) {
    const Point a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double area = a.x * b.y - a.y * b.x;
    if (area == 0) return;
    if (area < 0) std::swap(corners[1], corners[2]);
    if (is_draped) {
      builder_.add_draped(std::move(corners), grid_, drape_lift(grid_.spacing));
    } else {
      for (Point& p : corners) p.z += std::min(2.0, 0.02 * grid_.spacing);
      builder_.add_clipped(std::move(corners));
    }
  }

  FlatMesh& builder_;
  const TerrainGrid& grid_;
};

void add_small_lake(FlatMesh& builder, const TerrainGrid& grid, const Lake& lake) {
  std::vector<FlatMesh::Point> shore;
  const int corners = std::clamp(math::to_int32(8 * lake.radius / grid.spacing), least_corners, most_corners);
  for (int k = 0; k < corners; ++k) {
    const math::SinCos turn = math::sincos_degrees(360.0 * k / corners);
    const double away = shore_distance(lake, lake.east + turn.cos, lake.north + turn.sin, 1);
    shore.emplace_back(lake.east + away * turn.cos, lake.north + away * turn.sin, 0);
  }
  for (std::size_t k = 0; k < shore.size(); ++k) {
    builder.add_draped({{lake.east, lake.north, 0}, shore[k], shore[(k + 1) % shore.size()]}, grid,
                       drape_lift(grid.spacing));
  }
}

}  // namespace

bool is_wide_lake(const Lake& lake, double spacing) { return lake.radius > resolved_lake * spacing; }

void add_rivers(FlatMesh& builder, const World& world, const TileFrame& frame, const TerrainGrid& grid,
                Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const double reach = 100 + least_ribbon(grid.spacing);
  Ribbon ribbon(builder, grid);
  for (const CellKey& key : regions_near(world, box.west, box.south, box.east, box.north, reach)) {
    job.check();
    const auto region = region_at(world, key, job);
    for (const River& river : region->rivers) {
      if (river.west > box.east + reach || river.east < box.west - reach || river.south > box.north + reach ||
          river.north < box.south - reach || river.points.back().width < least_width * grid.spacing) {
        continue;
      }
      ribbon.add(simplified_line(river.points, bend_tolerance * grid.spacing), box);
    }
    for (const Lake& lake : region->lakes) {
      const double far = 1.3 * lake.radius;
      if (is_wide_lake(lake, grid.spacing) || lake.radius < least_lake * grid.spacing ||
          lake.east - far > box.east || lake.east + far < box.west || lake.north - far > box.north ||
          lake.north + far < box.south) {
        continue;
      }
      add_small_lake(builder, grid, lake);
    }
  }
}

}  // namespace seedmesh::world
