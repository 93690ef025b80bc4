#pragma once
/// Rasterizes triangles. Coordinates are fixed-point numbers, so that every machine finds the same samples. A
/// sample on an edge belongs to one of the two triangles that share it, so that none is missing or visited
/// twice.
///
/// Edge functions after Pineda, "A parallel algorithm for polygon rasterization", 1988.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/math.h"

namespace seedmesh::texture {

constexpr std::int64_t fixed_one = 16;  ///< a sample in fixed-point numbers

/// Returns a position in samples as a fixed-point number. It is clamped to a range outside of every image, so that
/// products of two still fit 64 bits.
inline std::int64_t fixed(double samples) {
  constexpr double farthest = 1 << 24;
  return math::to_int64(std::floor(std::clamp(samples, -farthest, farthest) * fixed_one + 0.5));
}

struct ScanPoint {
  std::int64_t x = 0, y = 0;  ///< fixed-point, y down
};

/// Samples [x0, x1) x [y0, y1).
struct ScanWindow {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Returns twice the area of a triangle in fixed-point units; above 0 if its corners run clockwise with y down.
inline std::int64_t scan_area(const std::array<ScanPoint, 3>& c) {
  return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
}

/// Calls visit(x, y, a, b, c) row by row for each sample of the window whose centre is inside the triangle.
/// a, b and c are the barycentric weights of the corners; their sum is 1. `area` is scan_area() and above 0.
/// Cost: about 2 ns for each sample of the bounding box.
template <class Visit>
void scan(const std::array<ScanPoint, 3>& corners, std::int64_t area, const ScanWindow& window,
          const Visit& visit) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const std::int64_t x0 = std::max(window.x0, left / fixed_one), y0 = std::max(window.y0, top / fixed_one);
  const std::int64_t x1 = std::min(window.x1 - 1, right / fixed_one);
  const std::int64_t y1 = std::min(window.y1 - 1, bottom / fixed_one);
  if (x0 > x1 || y0 > y1) return;
  struct Edge {
    std::int64_t across, down, least, row;
  };
  std::array<Edge, 3> edges;
  const std::int64_t px = x0 * fixed_one + fixed_one / 2, py = y0 * fixed_one + fixed_one / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScanPoint &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
    const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
    const bool is_top = dy == 0 && dx > 0, is_left = dy < 0;
    edges[i] = {-dy * fixed_one, dx * fixed_one, is_top || is_left ? 0 : 1,
                dx * (py - a.y) - dy * (px - a.x)};
  }
  const double whole = 1 / static_cast<double>(area);
  for (std::int64_t y = y0; y <= y1; ++y) {
    std::array<std::int64_t, 3> at = {edges[0].row, edges[1].row, edges[2].row};
    for (std::int64_t x = x0; x <= x1; ++x) {
      if (at[0] >= edges[0].least && at[1] >= edges[1].least && at[2] >= edges[2].least) {
        visit(x, y, static_cast<double>(at[0]) * whole, static_cast<double>(at[1]) * whole,
              static_cast<double>(at[2]) * whole);
      }
      for (std::size_t i = 0; i < 3; ++i) at[i] += edges[i].across;
    }
    for (Edge& edge : edges) edge.row += edge.down;
  }
}

}  // namespace seedmesh::texture
