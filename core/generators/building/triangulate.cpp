#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/solid.h"
#include "core/geom/triangulate.h"

namespace seedmesh::building {
namespace {

/// A flat loop: places in Solid::points with their positions in the plane of the face.
struct Ring {
  std::vector<std::uint32_t> point;
  std::vector<glm::dvec2> at;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

bool crosses(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const double p = cross(b - a, c - a), q = cross(b - a, d - a), r = cross(d - c, a - c),
               s = cross(d - c, b - c);
  return ((p > 0) != (q > 0)) && ((r > 0) != (s > 0)) && p != 0 && q != 0 && r != 0 && s != 0;
}

bool is_free(const Ring& ring, const glm::dvec2& a, const glm::dvec2& b) {
  for (std::size_t i = 0; i < ring.at.size(); ++i) {
    if (crosses(a, b, ring.at[i], ring.at[(i + 1) % ring.at.size()])) return false;
  }
  return true;
}

/// Cuts the outer ring open at the nearest corner that sees the hole, and leads it around the hole.
void bridge(Ring& outer, const Ring& hole, const std::vector<Ring>& others) {
  double best = 1e300;
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < outer.at.size(); ++i) {
    for (std::size_t k = 0; k < hole.at.size(); ++k) {
      const glm::dvec2 d = hole.at[k] - outer.at[i];
      const double distance = glm::dot(d, d);
      if (distance >= best || !is_free(outer, outer.at[i], hole.at[k])) continue;
      if (std::ranges::any_of(others,
                              [&](const Ring& ring) { return !is_free(ring, outer.at[i], hole.at[k]); }))
        continue;
      best = distance;
      from = i;
      to = k;
    }
  }
  Ring joined;
  const auto take = [&](const Ring& ring, std::size_t i) {
    joined.point.push_back(ring.point[i]);
    joined.at.push_back(ring.at[i]);
  };
  for (std::size_t i = 0; i <= from; ++i) take(outer, i);
  for (std::size_t k = 0; k <= hole.at.size(); ++k) take(hole, (to + k) % hole.at.size());
  for (std::size_t i = from; i < outer.at.size(); ++i) take(outer, i);
  outer = std::move(joined);
}

}  // namespace

void triangulate(const Solid& solid, const Face& face, const glm::dvec3& size,
                 std::vector<std::uint32_t>& out) {
  const glm::dvec3 normal = math::unit(area_vector(solid, face, size), glm::dvec3(0, 1, 0));
  const Loop& first = solid.loops[face.first_loop];
  const glm::dvec3 base = solid.points[solid.corners[first.first]] * size;
  glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), normal);
  if (glm::dot(x, x) < 1e-6) x = glm::cross(glm::dvec3(0, 0, 1), normal);
  x = math::unit(x, glm::dvec3(1, 0, 0));
  const glm::dvec3 y = glm::cross(normal, x);
  std::vector<Ring> rings(face.loop_count);
  double extent = 0;
  for (std::uint32_t l = 0; l < face.loop_count; ++l) {
    const Loop& loop = solid.loops[face.first_loop + l];
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const std::uint32_t point = solid.corners[loop.first + i];
      const glm::dvec3 p = solid.points[point] * size - base;
      rings[l].point.push_back(point);
      rings[l].at.emplace_back(glm::dot(p, x), glm::dot(p, y));
      extent = std::max(extent, glm::length(p));
    }
  }
  if (face.loop_count == 1 && rings[0].point.size() <= 4 && rings[0].point.size() >= 3) {
    const auto& at = rings[0].at;
    const std::size_t n = at.size();
    bool convex = true;
    for (std::size_t i = 0; i < n; ++i)
      convex &= cross(at[(i + 1) % n] - at[i], at[(i + 2) % n] - at[(i + 1) % n]) > 1e-9 * extent * extent;
    if (convex) {
      for (std::size_t i = 2; i < n; ++i)
        out.insert(out.end(), {rings[0].point[0], rings[0].point[i - 1], rings[0].point[i]});
      return;
    }
  }
  Ring outer = std::move(rings[0]);
  std::vector<Ring> holes(std::make_move_iterator(rings.begin() + 1), std::make_move_iterator(rings.end()));
  while (!holes.empty()) {
    const Ring hole = std::move(holes.back());
    holes.pop_back();
    bridge(outer, hole, holes);
  }
  Triangulator triangulator;
  for (const std::uint32_t i : triangulator.run(outer.at, 1e-11 * extent * extent))
    out.push_back(outer.point[i]);
}

}  // namespace seedmesh::building
