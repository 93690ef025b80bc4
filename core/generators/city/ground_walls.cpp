// The upright faces of the ground: kerbs, walls, quays and foundations.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/ground_mesh.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double same_height = 1e-3;      // m
constexpr double foundation_depth = 0.5;  // m
// Widths of the part of a foundation beside its building, m. The least one fits on each lot with a house.
constexpr std::array<double, 3> ledges = {0.1, 0.05, 0.02};
constexpr double least_ledge = 0.003, apart = 0.002;

/// The direction to the right of an edge, seen from above; north is -Z.
glm::vec3 right_side(const dvec2& from, const dvec2& to) {
  const dvec2 edge = (to - from) / glm::length(to - from);
  return {static_cast<float>(edge.y), 0, static_cast<float>(edge.x)};
}

std::array<dvec2, 4> corners_of(const Footing& footing, double ledge) {
  const math::SinCos turn = math::sincos_degrees(footing.turn);
  const double x = footing.width / 2 + ledge, y = footing.depth / 2 + ledge;
  std::array<dvec2, 4> corners = {dvec2(-x, -y), {x, -y}, {x, y}, {-x, y}};
  for (dvec2& p : corners)
    p = footing.position + dvec2(p.x * turn.cos - p.y * turn.sin, p.x * turn.sin + p.y * turn.cos);
  return corners;
}

/// Whether a ring has all of these corners inside, and none of its own corners between them.
bool contains(const CmRing& ring, const std::array<dvec2, 4>& corners) {
  const auto is_left_of_all = [&](const CmPoint& p) {
    for (std::size_t k = 0; k < 4; ++k) {
      const dvec2 along = corners[(k + 1) % 4] - corners[k], off = in_metres(p) - corners[k];
      if (along.x * off.y - along.y * off.x < 0) return false;
    }
    return true;
  };
  return std::all_of(corners.begin(), corners.end(),
                     [&](const dvec2& p) { return is_inside(ring, p * 100.0); }) &&
         std::none_of(ring.begin(), ring.end(), is_left_of_all);
}

/// The corners of a foundation, with the widest ledge that keeps it on its lot. So foundations of neighbours do not meet.
std::array<dvec2, 4> foundation_of(const Footing& footing, const Part& part) {
  for (const double ledge : ledges) {
    if (part.kind != PartKind::lot || contains(part.rings[0], corners_of(footing, ledge + apart)))
      return corners_of(footing, ledge);
  }
  return corners_of(footing, least_ledge);
}

}  // namespace

void GroundMesh::add_walls(std::uint32_t number) {
  const Part& part = plan_.parts[number];
  if (part.kind == PartKind::water) return;
  for (const CmRing& ring : part.rings) add_walls_of(number, ring);
}

/// The walls along a ring. Rounded corners are smooth: their short edges have common normals.
void GroundMesh::add_walls_of(std::uint32_t number, const CmRing& ring) {
  constexpr double short_edge = 3, least_cosine = 0.76;  // m
  const std::size_t count = ring.size();
  wall_edges_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const CmPoint &a = ring[i], &b = ring[i + 1 < count ? i + 1 : 0];
    const dvec2 from = in_metres(a), to = in_metres(b);
    const std::uint32_t beyond = surface_.part_beyond(a, b);
    const bool is_left_out =
        (beyond == no_index && !plan_.parts[number].is_wall) ||
        (surface_.is_level() &&
         surface_.height(number, from) - low_height(number, beyond, from) <= same_height);
    wall_edges_.push_back({beyond, is_left_out, glm::length(to - from) < short_edge, right_side(from, to)});
  }
  const auto normal_between = [this](std::size_t i, std::size_t k, std::size_t own) {
    const WallEdge &before = wall_edges_[i], &after = wall_edges_[k];
    const bool is_smooth = !before.is_left_out && !after.is_left_out && before.is_short && after.is_short &&
                           glm::dot(before.normal, after.normal) > static_cast<float>(least_cosine);
    if (!is_smooth) return wall_edges_[own].normal;
    return glm::vec3(math::unit(glm::dvec3(before.normal + after.normal), {0, 1, 0}));
  };
  double along = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const WallEdge& edge = wall_edges_[i];
    if (edge.is_left_out) {
      along = 0;
      continue;
    }
    const std::size_t next = i + 1 < count ? i + 1 : 0;
    surface_.points_between(ring[i], ring[next], between_);
    between_.push_back(in_metres(ring[next]));
    const auto point_at = [&](const dvec2& at, const glm::vec3& normal) {
      return WallPoint{at, low_height(number, edge.beyond, at), surface_.height(number, at), along, normal};
    };
    WallPoint before = point_at(in_metres(ring[i]), normal_between(i > 0 ? i - 1 : count - 1, i, i));
    for (std::size_t k = 0; k < between_.size(); ++k) {
      along += glm::length(between_[k] - before.at);
      const bool is_last = k + 1 == between_.size();
      const WallPoint here = point_at(between_[k], is_last ? normal_between(i, next, i) : edge.normal);
      add_wall(before, here);
      before = here;
    }
  }
}

/// The height of what is beyond an edge of a part.
double GroundMesh::low_height(std::uint32_t part, std::uint32_t beyond, const dvec2& at) const {
  return beyond != no_index ? surface_.height(beyond, at)
                            : surface_.height(part, at) - surface_.wall_height();
}

/// The upright face between two points of an edge whose left side is higher: a triangle where one end has no height, and
/// the part above the opening of a tunnel.
void GroundMesh::add_wall(WallPoint a, WallPoint b) {
  if (const auto lintel = surface_.tunnels().lintel((a.at + b.at) / 2.0)) a.low = b.low = *lintel;
  const bool has_start = a.high - a.low > same_height, has_end = b.high - b.low > same_height;
  if (!has_start && !has_end) return;
  const auto add = [this](const WallPoint& p, double height) {
    return add_vertex(p.at, height, p.normal,
                      {static_cast<float>(p.along), static_cast<float>(height - std::min(p.low, p.high))});
  };
  const std::uint32_t first = add(a, std::min(a.low, a.high)), second = add(b, std::min(b.low, b.high));
  std::uint32_t third = 0;
  if (has_end) {
    third = add(b, b.high);
    for (const std::uint32_t corner : {first, second, third}) mesh_.index.wide.push_back(corner);
    if (!has_start) return;
    const std::uint32_t fourth = add(a, a.high);
    for (const std::uint32_t corner : {first, third, fourth}) mesh_.index.wide.push_back(corner);
    return;
  }
  third = add(a, a.high);
  for (const std::uint32_t corner : {first, second, third}) mesh_.index.wide.push_back(corner);
}

void GroundMesh::add_foundation(const Footing& footing) {
  double lowest = 0;
  constexpr double plinth = 0.02;  // m: keeps its top apart from the house's underside
  const double top_height = surface_.floor_height(footing, lowest) + plinth;
  const std::array<dvec2, 4> ring = foundation_of(footing, plan_.parts[footing.part]);
  const double low = lowest - foundation_depth;
  std::array<std::uint32_t, 4> top{};
  for (std::size_t k = 0; k < 4; ++k) {
    const dvec2 &a = ring[k], &b = ring[(k + 1) % 4];
    const glm::vec3 normal = right_side(a, b);
    add_wall({a, low, top_height, 0, normal}, {b, low, top_height, glm::length(b - a), normal});
  }
  for (std::size_t k = 0; k < 4; ++k) top[k] = add_vertex(ring[k], top_height, {0, 1, 0}, glm::vec2(ring[k]));
  for (const std::size_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh_.index.wide.push_back(top[k]);
}

}  // namespace seedmesh::city
