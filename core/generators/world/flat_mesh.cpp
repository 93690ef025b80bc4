#include "core/generators/world/flat_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/math.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

using Point = FlatMesh::Point;
constexpr double overlap = 0.2;  ///< share of the width, at the end of a ribbon

/// Sutherland and Hodgman 1974, for one side.
std::vector<Point> clipped(const std::vector<Point>& polygon, int axis, double bound, double sign) {
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

}  // namespace

TileVertex FlatMesh::vertex_of(const Point& p) const {
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

std::uint32_t FlatMesh::index_of(const Point& p) {
  const TileVertex vertex = vertex_of(p);
  const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
  const auto [found, is_new] = known_.try_emplace({vertex.x, vertex.y, vertex.z}, next);
  if (is_new) mesh_.vertices.push_back(vertex);
  return found->second;
}

void FlatMesh::add(const std::vector<Point>& polygon) {
  std::vector<std::uint32_t> corners;
  corners.reserve(polygon.size());
  for (const Point& p : polygon) corners.push_back(index_of(p));
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::uint32_t a = corners[0], b = corners[k - 1], c = corners[k];
    if (a == b || b == c || c == a) continue;
    for (const std::uint32_t corner : {a, b, c}) mesh_.indices.push_back(corner);
  }
}

void FlatMesh::add_rectangle(double west, double south, double east, double north, double height) {
  add({{west, south, height}, {east, south, height}, {east, north, height}, {west, north, height}});
}

void FlatMesh::add_rectangle(const glm::dvec2& low, const glm::dvec2& high, double height,
                             const std::array<std::array<std::uint8_t, 4>, 4>& colors) {
  const std::array<Point, 4> corners{Point(low, height), Point(high.x, low.y, height), Point(high, height),
                                     Point(low.x, high.y, height)};
  std::array<std::uint32_t, 4> own{};
  for (std::size_t k = 0; k < 4; ++k) {
    color_ = colors[k];
    own[k] = index_of(corners[k]);
  }
  // the diagonal between more similar colours, along which lines of one colour have no teeth
  const auto difference = [&](std::size_t a, std::size_t b) {
    int sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::abs(colors[a][k] - colors[b][k]);
    return sum;
  };
  const std::size_t from = difference(0, 2) <= difference(1, 3) ? 0 : 1;
  const std::uint32_t a = own[from], b = own[from + 1], c = own[from + 2], d = own[(from + 3) % 4];
  mesh_.indices.insert(mesh_.indices.end(), {a, b, c, a, c, d});
}

void FlatMesh::add_clipped(std::vector<Point> polygon) {
  for (int axis = 0; axis < 2; ++axis) {
    const double low = axis == 0 ? frame_.west : frame_.south;
    polygon = clipped(polygon, axis, low, 1);
    polygon = clipped(polygon, axis, low + frame_.side, -1);
  }
  if (polygon.size() > 2) add(polygon);
}

void FlatMesh::add_ribbon(const Point& from, double from_width, const Point& to, double to_width) {
  const glm::dvec2 along(to.x - from.x, to.y - from.y);
  const double length = std::sqrt(along.x * along.x + along.y * along.y);
  if (length <= 0) return;
  const Point way(along.x / length, along.y / length, 0), side(-way.y, way.x, 0);
  const Point end = to + way * (overlap * to_width);
  const Point s = side * (from_width / 2), t = side * (to_width / 2);
  add_clipped({from - s, end - t, end + t, from + s});
}

}  // namespace seedmesh::world
