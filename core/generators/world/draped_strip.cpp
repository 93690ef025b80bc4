/// Strips on the triangles of the terrain. A line is cut where it crosses the sides and diagonals of cells; between
/// the cuts the terrain below it is plane. Cuts that the strip can do without are left out again.
///
/// D. H. Douglas and T. K. Peucker 1973, "Algorithms for the reduction of the number of points required to represent a
/// digitized line or its caricature".
#include "core/generators/world/draped_strip.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::world {
namespace {

using Point = FlatMesh::Point;

constexpr double least_gap = 1e-9;            ///< share of a strip between two cuts
constexpr double deepest = 0.6, highest = 1;  ///< shares of the lift by which a strip may differ from it
constexpr double farthest = 0.999;            ///< cells beyond a tile whose heights are known

/// A cut across a strip. Its share of the strip, its edges on the terrain, and whether it has to stay.
struct Cut {
  double share = 0;
  Point left{}, right{};
  bool is_kept = false;
};

Point between(const Point& a, const Point& b, double t) { return a + t * (b - a); }

/// The height of the triangles of the terrain at a position, in cells.
double height_at(const TerrainGrid& grid, double u, double v) {
  const double last = grid.count - 1 + farthest;
  u = std::clamp(u, -farthest, last);
  v = std::clamp(v, -farthest, last);
  const int column = math::to_int32(std::floor(u)), row = math::to_int32(std::floor(v));
  const double x = u - column, y = v - row;
  const double sw = grid.at(column, row).height, ne = grid.at(column + 1, row + 1).height;
  if (x >= y) {
    const double se = grid.at(column + 1, row).height;
    return sw + x * (se - sw) + y * (ne - se);
  }
  const double nw = grid.at(column, row + 1).height;
  return sw + x * (ne - nw) + y * (nw - sw);
}

class Strip {
 public:
  Strip(const TerrainGrid& grid, const StripEdges& from, const StripEdges& to, double lift)
      : grid_(grid), from_(from), to_(to), lift_(lift) {}

  /// The cuts that the tile needs, in order.
  std::vector<Cut> cuts() {
    const Point a = in_cells(between(from_.left, from_.right, 0.5));
    const Point b = in_cells(between(to_.left, to_.right, 0.5));
    const double last = grid_.count;
    // the part that lies in the tile or in the cells around it
    double first = 0, end = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const double by = b[axis] - a[axis];
      if (by == 0) {
        if (a[axis] < -1 || a[axis] > last) return {};
        continue;
      }
      const double t = (-1 - a[axis]) / by, s = (last - a[axis]) / by;
      first = std::max(first, std::min(t, s));
      end = std::min(end, std::max(t, s));
    }
    if (first >= end) return {};
    add_cut(first, true);
    add_cut(end, true);
    for (int axis = 0; axis < 2; ++axis) add_crossings(a[axis], b[axis], first, end, true);
    add_crossings(a.x - a.y, b.x - b.y, first, end, false);
    std::sort(cuts_.begin(), cuts_.end(), [](const Cut& p, const Cut& q) { return p.share < q.share; });
    return needed();
  }

 private:
  Point in_cells(const Point& p) const {
    return {(p.x - grid_.west) / grid_.spacing, (p.y - grid_.south) / grid_.spacing, 0};
  }

  Point on_terrain(Point p) const {
    const Point q = in_cells(p);
    p.z = height_at(grid_, q.x, q.y) + lift_;
    return p;
  }

  void add_cut(double t, bool is_kept) {
    cuts_.push_back({t, on_terrain(between(from_.left, to_.left, t)),
                     on_terrain(between(from_.right, to_.right, t)), is_kept});
  }

  /// Adds cuts where a coordinate that changes from `a` to `b` is whole.
  void add_crossings(double a, double b, double first, double end, bool has_borders) {
    if (a == b) return;
    const double low = std::min(a + first * (b - a), a + end * (b - a));
    const double high = std::max(a + first * (b - a), a + end * (b - a));
    for (double line = std::ceil(low); line <= high; line += 1) {
      const double t = (line - a) / (b - a);
      if (t > first && t < end) add_cut(t, has_borders && (line == 0 || line == grid_.count - 1));
    }
  }

  /// Whether a strip without the cuts between two others stays near the terrain.
  bool is_near(std::size_t from, std::size_t to) const {
    const Cut &a = cuts_[from], &b = cuts_[to];
    for (std::size_t k = from + 1; k < to; ++k) {
      const Cut& cut = cuts_[k];
      const double t = (cut.share - a.share) / (b.share - a.share);
      for (const double above :
           {between(a.left, b.left, t).z - cut.left.z, between(a.right, b.right, t).z - cut.right.z}) {
        if (above < -deepest * lift_ || above > highest * lift_) return false;
      }
    }
    return true;
  }

  std::vector<Cut> needed() const {
    std::vector<Cut> kept{cuts_.front()};
    std::size_t from = 0;
    for (std::size_t k = 1; k < cuts_.size(); ++k) {
      const bool is_last = k + 1 == cuts_.size();
      const bool is_needed = cuts_[k].is_kept || is_last || !is_near(from, k + 1);
      if (!is_needed || (!is_last && cuts_[k].share - kept.back().share < least_gap)) continue;
      kept.push_back(cuts_[k]);
      from = k;
    }
    return kept;
  }

  const TerrainGrid& grid_;
  const StripEdges &from_, &to_;
  double lift_;
  std::vector<Cut> cuts_;
};

void add_triangle(FlatMesh& builder, const Point& a, Point b, Point c) {
  const Point p = b - a, q = c - a;
  const double area = p.x * q.y - p.y * q.x;
  if (area == 0) return;
  if (area < 0) std::swap(b, c);
  builder.add_clipped({a, b, c});
}

double distance_from_line(const RiverPoint& p, const RiverPoint& a, const RiverPoint& b) {
  const double x = b.east - a.east, y = b.north - a.north, square = x * x + y * y;
  const double px = p.east - a.east, py = p.north - a.north;
  const double t = square > 0 ? std::clamp((px * x + py * y) / square, 0.0, 1.0) : 0;
  const double dx = px - t * x, dy = py - t * y;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

void add_draped_strip(FlatMesh& builder, const TerrainGrid& grid, const StripEdges& from,
                      const StripEdges& to, double lift) {
  const std::vector<Cut> cuts = Strip(grid, from, to, lift).cuts();
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const Cut &a = cuts[k - 1], &b = cuts[k];
    add_triangle(builder, a.right, b.right, b.left);
    add_triangle(builder, a.right, b.left, a.left);
  }
}

std::vector<RiverPoint> simplified_line(const std::vector<RiverPoint>& points, double tolerance) {
  std::vector<bool> is_kept(points.size(), false);
  is_kept.front() = is_kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double most = tolerance;
    std::size_t farthest_point = 0;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double away = distance_from_line(points[k], points[from], points[to]);
      if (away <= most) continue;
      most = away;
      farthest_point = k;
    }
    if (farthest_point == 0) continue;
    is_kept[farthest_point] = true;
    open.emplace_back(from, farthest_point);
    open.emplace_back(farthest_point, to);
  }
  std::vector<RiverPoint> kept;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (is_kept[k]) kept.push_back(points[k]);
  }
  return kept;
}

}  // namespace seedmesh::world
