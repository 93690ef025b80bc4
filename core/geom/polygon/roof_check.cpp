// The check of a roof; see roof_surface.h.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "core/geom/polygon/roof_surface.h"

namespace seedmesh {
namespace {

/// For each point of the roof the number of the first point with the same coordinates in single precision.
std::vector<std::uint32_t> numbers_of(const Roof& roof) {
  std::vector<std::pair<std::array<float, 3>, std::uint32_t>> order;
  for (const glm::dvec3& point : roof.point) {
    const glm::vec3 p = glm::vec3(point) + 0.0F;
    order.push_back({{p.x, p.y, p.z}, static_cast<std::uint32_t>(order.size())});
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && order[i].first == order[i - 1].first;
    number[order[i].second] = is_same ? number[order[i - 1].second] : order[i].second;
  }
  return number;
}

/// The triangles of a face with those that have no area.
std::vector<std::uint32_t> all_triangles(const Roof& roof, const RoofFace& face, const Job& job) {
  const glm::dvec3 across = glm::cross(face.normal, face.along);
  Plan flat;
  std::vector<std::uint32_t> point;
  const auto add = [&](const std::vector<std::uint32_t>& loop) {
    flat.rings.emplace_back();
    for (const std::uint32_t i : loop) {
      flat.rings.back().emplace_back(glm::dot(roof.point[i], face.along), glm::dot(roof.point[i], across));
      point.push_back(i);
    }
  };
  add(face.outline);
  for (const auto& hole : face.holes) add(hole);
  std::vector<std::uint32_t> triangles = triangulate(flat, ThinTriangles::keep, &job);
  for (std::uint32_t& i : triangles) i = point[i];
  return triangles;
}

}  // namespace

bool is_closed(const Roof& roof, bool is_cover, const Job& job) {
  const std::vector<std::uint32_t> number = numbers_of(roof);
  std::vector<std::array<std::uint32_t, 3>> edges;  // the lower number, the higher one, 1 where it goes down
  for (const RoofFace& face : roof.faces) {
    if (face.is_cover != is_cover) continue;
    job.check();
    const std::vector<std::uint32_t> corners = all_triangles(roof, face, job);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = number[corners[i]], b = number[corners[i % 3 == 2 ? i - 2 : i + 1]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a > b ? 1U : 0U});
    }
  }
  std::sort(edges.begin(), edges.end());
  job.check();
  if (edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const auto &up = edges[i], &down = edges[i + 1];
    if (up[0] != down[0] || up[1] != down[1] || up[2] != 0 || down[2] != 1) return false;
    if (i > 0 && up[0] == edges[i - 1][0] && up[1] == edges[i - 1][1]) return false;
  }
  return true;
}

}  // namespace seedmesh
