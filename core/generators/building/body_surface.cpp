#include "core/generators/building/body_surface.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

void SurfaceBuilder::box(const glm::dvec3& size, BodySurface& surface) {
  const int flat = dimension(size) == 2 ? flat_axis(size) : -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (flat >= 0 && axis != flat) continue;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      if (flat >= 0 && side == 0) continue;
      const auto base = static_cast<std::uint32_t>(surface.position.size());
      glm::dvec3 normal(0);
      normal[axis] = side == 1 ? 1 : -1;
      for (int k = 0; k < 4; ++k) {
        glm::dvec3 p(0);
        p[axis] = side == 1 ? size[axis] : 0;
        const bool second = k == 1 || k == 2, third = k >= 2;
        p[side == 1 ? u : v] = second ? size[side == 1 ? u : v] : 0;
        p[side == 1 ? v : u] = third ? size[side == 1 ? v : u] : 0;
        surface.position.push_back(p);
        surface.normal.push_back(normal);
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) surface.index.push_back(base + k);
    }
  }
}

/// Fills triangles_ with points of the solid, three for each triangle of the face.
void SurfaceBuilder::triangulate(const Solid& solid, const Face& face, const glm::dvec3& normal,
                                 const glm::dvec3& size) {
  constexpr double least_area = 1e-11;  // as a share of the squared extent
  const glm::dvec3 base = solid.points[solid.corners[solid.loops[face.first_loop].first]] * size;
  glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), normal);
  if (glm::dot(x, x) < 1e-6) x = glm::cross(glm::dvec3(0, 0, 1), normal);
  x = math::unit(x, glm::dvec3(1, 0, 0));
  const glm::dvec3 y = glm::cross(normal, x);
  flat_.clear();
  face_points_.clear();
  ring_sizes_.clear();
  double extent = 0;
  for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
    const Loop& loop = solid.loops[l];
    ring_sizes_.push_back(loop.count);
    for (std::uint32_t i = loop.first; i < loop.first + loop.count; ++i) {
      face_points_.push_back(solid.corners[i]);
      const glm::dvec3 p = solid.points[solid.corners[i]] * size - base;
      flat_.emplace_back(glm::dot(p, x), glm::dot(p, y));
      extent = std::max(extent, glm::length(p));
    }
  }
  triangles_.clear();
  for (const std::uint32_t i : triangulator_.run(flat_, ring_sizes_, least_area * extent * extent))
    triangles_.push_back(face_points_[i]);
}

void SurfaceBuilder::solid(const Solid& solid, const glm::dvec3& size, BodySurface& surface) {
  smooth_.assign(solid.points.size(), glm::dvec3(0));
  place_.assign(solid.points.size(), none);
  for (const Face& face : solid.faces) {
    if (!face.is_round) continue;
    const glm::dvec3 normal = math::unit(area_vector(solid, face, size), glm::dvec3(0));
    const Loop& loop = solid.loops[face.first_loop];
    for (std::uint32_t i = 0; i < loop.count; ++i) smooth_[solid.corners[loop.first + i]] += normal;
  }
  for (const Face& face : solid.faces) {
    const glm::dvec3 normal = math::unit(area_vector(solid, face, size), glm::dvec3(0));
    if (normal == glm::dvec3(0)) continue;
    triangulate(solid, face, normal, size);
    for (const std::uint32_t point : triangles_) {
      if (place_[point] == none) {
        place_[point] = static_cast<std::uint32_t>(surface.position.size());
        surface.position.push_back(solid.points[point] * size);
        surface.normal.push_back(face.is_round ? math::unit(smooth_[point], normal) : normal);
      }
      surface.index.push_back(place_[point]);
    }
    for (const std::uint32_t point : triangles_) place_[point] = none;
  }
}

}  // namespace seedmesh::building
