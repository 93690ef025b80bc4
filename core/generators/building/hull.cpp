#include "core/generators/building/hull.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::building {
namespace {

/// The farthest points in evenly spread directions (a Fibonacci lattice), without duplicates.
std::vector<glm::dvec3> farthest_of(std::span<const glm::dvec3> points) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < most_hull_points; ++i) {
    const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(most_hull_points);
    const double radius = std::sqrt(std::max(0.0, 1 - y * y));
    const math::SinCos turn = math::sincos_degrees(137.50776405003785 * static_cast<double>(i));
    const glm::dvec3 way(radius * turn.cos, y, radius * turn.sin);
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (glm::dot(points[k], way) > glm::dot(points[best], way)) best = k;
    }
    chosen.push_back(best);
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<glm::dvec3> out;
  out.reserve(chosen.size());
  for (const std::size_t i : chosen) out.push_back(points[i]);
  return out;
}

/// The corners of a convex polygon among points of a plane, counter-clockwise about its normal (Andrew 1979).
std::vector<std::uint32_t> outline_of(const std::vector<glm::dvec3>& points, std::vector<std::uint32_t> all,
                                      const glm::dvec3& normal, double near) {
  const glm::dvec3 x = math::unit(points[all[1]] - points[all[0]], glm::dvec3(1, 0, 0));
  const glm::dvec3 y = glm::cross(normal, x);
  const auto at = [&](std::uint32_t i) { return glm::dvec2(glm::dot(points[i], x), glm::dot(points[i], y)); };
  std::ranges::sort(all, [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec2 p = at(a), q = at(b);
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  });
  const auto turns_left = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec2 u = at(b) - at(a), v = at(c) - at(b);
    return u.x * v.y - u.y * v.x > near * (glm::length(u) + glm::length(v));
  };
  std::vector<std::uint32_t> out;
  for (const bool is_back : {false, true}) {
    const std::size_t first = out.size() + 1;
    for (std::size_t k = is_back ? 1 : 0; k < all.size(); ++k) {
      const std::uint32_t next = is_back ? all[all.size() - 1 - k] : all[k];
      while (out.size() > (is_back ? first - 1 : 1) && out.size() >= 2 &&
             !turns_left(out[out.size() - 2], out.back(), next))
        out.pop_back();
      out.push_back(next);
    }
  }
  out.pop_back();
  return out;
}

}  // namespace

Solid hull_of(std::span<const glm::dvec3> given) {
  Solid hull;
  std::vector<glm::dvec3> points;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : given) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double extent = given.empty() ? 0 : glm::length(high - low), near = 1e-7 * extent;
  for (const glm::dvec3& p : given) {
    if (std::ranges::none_of(points, [&](const glm::dvec3& q) { return glm::length(p - q) <= near; }))
      points.push_back(p);
  }
  if (points.size() > most_hull_points) points = farthest_of(points);
  if (points.size() < 4) return hull;
  hull.points = points;
  std::vector<std::array<std::uint32_t, 3>> seen;  // the first three corners of each face
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<std::uint32_t> on;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) {
        glm::dvec3 normal = glm::cross(points[j] - points[i], points[k] - points[i]);
        const double size = glm::length(normal);
        if (size <= near * extent) continue;
        normal /= size;
        double least = 0, most = 0;
        for (const glm::dvec3& p : points) {
          const double height = glm::dot(normal, p - points[i]);
          least = std::min(least, height);
          most = std::max(most, height);
        }
        if (least < -near && most > near) continue;
        if (least >= -near && most <= near) return Solid{};  // all in a plane
        if (most > near) normal = -normal;
        on.clear();
        for (std::uint32_t p = 0; p < count; ++p) {
          if (std::abs(glm::dot(normal, points[p] - points[i])) <= near) on.push_back(p);
        }
        // The same plane occurs for every three of its points; its three lowest points identify it.
        const std::array<std::uint32_t, 3> name{on[0], on[1], on[2]};
        if (std::ranges::find(seen, name) != seen.end()) continue;
        seen.push_back(name);
        faces.push_back(outline_of(points, on, normal, near));
      }
    }
  }
  for (const std::vector<std::uint32_t>& face : faces) {
    if (face.size() >= 3) add_face(hull, face);
  }
  hull.is_closed = true;
  return hull;
}

}  // namespace seedmesh::building
