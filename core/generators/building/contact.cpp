#include "core/generators/building/contact.h"

#include <algorithm>
#include <cmath>

#include "core/generators/building/solid_tools.h"

namespace seedmesh::building {
namespace {

constexpr double near_share = 1e-7;  ///< share of the largest size

using Triangle = std::array<glm::dvec3, 3>;

bool are_apart(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, double near) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const glm::dvec3& p, const glm::dvec3& q) { return p[axis] < q[axis]; };
    const auto [a_low, a_high] = std::ranges::minmax_element(a, less);
    const auto [b_low, b_high] = std::ranges::minmax_element(b, less);
    if ((*a_low)[axis] > (*b_high)[axis] + near || (*b_low)[axis] > (*a_high)[axis] + near) return true;
  }
  return false;
}

/// The part of a plane polygon on the inner side of the edge from `a` to `b` of a triangle with this normal.
std::vector<glm::dvec3> cut(const std::vector<glm::dvec3>& polygon, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& normal) {
  const glm::dvec3 inwards = glm::cross(normal, b - a);
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at = glm::dot(inwards, p - a), next = glm::dot(inwards, q - a);
    if (at >= 0) kept.push_back(p);
    if ((at > 0 && next < 0) || (at < 0 && next > 0)) kept.push_back(p + (q - p) * (at / (at - next)));
  }
  return kept;
}

/// Whether two triangles of one plane have an area in common.
bool share_area(const Triangle& a, const Triangle& b, bool have_sides, double near) {
  if (are_apart(a, b, near)) return false;
  const glm::dvec3 normal = glm::cross(a[1] - a[0], a[2] - a[0]);
  const double length = glm::length(normal);
  const glm::dvec3 other = glm::cross(b[1] - b[0], b[2] - b[0]);
  if (!(length > 0) || (have_sides && glm::dot(normal, other) >= 0)) return false;
  for (const glm::dvec3& p : b) {
    if (std::abs(glm::dot(normal, p - a[0])) > near * length) return false;
  }
  std::vector<glm::dvec3> common(b.begin(), b.end());
  for (std::size_t i = 0; i < 3 && !common.empty(); ++i) common = cut(common, a[i], a[(i + 1) % 3], normal);
  glm::dvec3 doubled(0);
  for (std::size_t i = 2; i < common.size(); ++i)
    doubled += glm::cross(common[i - 1] - common[0], common[i] - common[0]);
  // A strip as wide as the tolerance is no area.
  return glm::length(doubled) > 4 * near * std::sqrt(length);
}

using Segment = std::pair<glm::dvec3, glm::dvec3>;

/// Whether two segments have a length in common.
bool share_length(const Segment& a, const Segment& b, double near) {
  const std::array<glm::dvec3, 2> mine{a.first, a.second}, theirs{b.first, b.second};
  if (are_apart(mine, theirs, near)) return false;
  const double length = glm::length(a.second - a.first);
  if (!(length > near)) return false;
  const glm::dvec3 along = (a.second - a.first) / length;
  double low = length, high = 0;
  for (const glm::dvec3& p : theirs) {
    const double at = glm::dot(along, p - a.first);
    if (glm::length(p - a.first - along * at) > near) return false;
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return std::min(high, length) - std::max(low, 0.0) > 4 * near;
}

bool share_end(const Segment& a, const Segment& b, double near) {
  const auto meet = [near](const glm::dvec3& p, const glm::dvec3& q) { return glm::length(p - q) <= near; };
  return meet(a.first, b.first) || meet(a.first, b.second) || meet(a.second, b.first) ||
         meet(a.second, b.second);
}

}  // namespace

Outline outline_of(const Derivation& d, const ShapeState& state) {
  Outline outline;
  outline.dimension = dimension(state.size);
  outline.near = near_share * std::max({state.size.x, state.size.y, state.size.z});
  const glm::dmat3& axes = d.out.axes[state.axes];
  const auto in_world = [&](const glm::dvec3& p) { return state.origin + axes * (p * state.size); };
  ShapeState seen = state;
  if (state.has_asset()) seen.geometry = box_geometry;
  std::vector<glm::dvec3> points;
  if (outline.dimension == 1) {
    points = {in_world(glm::dvec3(0)), in_world(glm::dvec3(1))};
    outline.segments.emplace_back(points[0], points[1]);
  } else if (outline.dimension > 1) {
    const Solid solid = solid_of(d, seen);
    for (const glm::dvec3& p : solid.points) points.push_back(in_world(p));
    for (const Face& face : solid.faces) {
      const std::vector<std::uint32_t> corners = triangles_of(solid, face, d.job);
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        outline.triangles.push_back({points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]});
      if (outline.dimension == 3) continue;
      for (const Loop& loop : loops_of(solid, face)) {
        const std::span<const std::uint32_t> around = points_of(solid, loop);
        for (std::size_t i = 0; i < around.size(); ++i)
          outline.segments.emplace_back(points[around[i]], points[around[(i + 1) % around.size()]]);
      }
    }
  }
  if (points.empty()) points.push_back(state.origin);
  outline.box = {points[0], points[0]};
  for (const glm::dvec3& p : points) {
    outline.box.low = glm::min(outline.box.low, p);
    outline.box.high = glm::max(outline.box.high, p);
  }
  outline.box.low -= outline.near;
  outline.box.high += outline.near;
  return outline;
}

bool are_neighbours(const Outline& a, const Outline& b) {
  const double near = std::max(a.near, b.near);
  const int least = std::min(a.dimension, b.dimension), most = std::max(a.dimension, b.dimension);
  if (least == 0 || (least == 1 && most > 1)) return false;
  if (most == 3) {
    return std::ranges::any_of(a.triangles, [&](const Triangle& mine) {
      return std::ranges::any_of(
          b.triangles, [&](const Triangle& theirs) { return share_area(mine, theirs, least == 3, near); });
    });
  }
  return std::ranges::any_of(a.segments, [&](const Segment& mine) {
    return std::ranges::any_of(b.segments, [&](const Segment& theirs) {
      return most == 1 ? share_end(mine, theirs, near) : share_length(mine, theirs, near);
    });
  });
}

}  // namespace seedmesh::building
