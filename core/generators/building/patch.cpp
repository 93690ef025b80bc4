#include "core/generators/building/patch.h"

#include "core/base/math.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

void PatchMaker::box(const glm::dvec3& size, Patch& patch) {
  const int flat = dimension(size) == 2 ? flat_axis(size) : -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (flat >= 0 && axis != flat) continue;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      if (flat >= 0 && side == 0) continue;
      const auto base = static_cast<std::uint32_t>(patch.position.size());
      glm::dvec3 normal(0);
      normal[axis] = side == 1 ? 1 : -1;
      for (int k = 0; k < 4; ++k) {
        glm::dvec3 p(0);
        p[axis] = side == 1 ? size[axis] : 0;
        const bool second = k == 1 || k == 2, third = k >= 2;
        p[side == 1 ? u : v] = second ? size[side == 1 ? u : v] : 0;
        p[side == 1 ? v : u] = third ? size[side == 1 ? v : u] : 0;
        patch.position.push_back(p);
        patch.normal.push_back(normal);
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) patch.index.push_back(base + k);
    }
  }
}

void PatchMaker::solid(const Solid& solid, const glm::dvec3& size, Patch& patch) {
  smooth_.assign(solid.points.size(), glm::dvec3(0));
  for (const Face& face : solid.faces) {
    if (!face.is_round) continue;
    const glm::dvec3 normal = math::unit(area_vector(solid, face, size), glm::dvec3(0));
    const Loop& loop = solid.loops[face.first_loop];
    for (std::uint32_t i = 0; i < loop.count; ++i) smooth_[solid.corners[loop.first + i]] += normal;
  }
  for (const Face& face : solid.faces) {
    const glm::dvec3 normal = math::unit(area_vector(solid, face, size), glm::dvec3(0));
    if (normal == glm::dvec3(0)) continue;
    triangles_.clear();
    triangulate(solid, face, size, triangles_);
    place_.assign(solid.points.size(), none);
    for (const std::uint32_t point : triangles_) {
      if (place_[point] == none) {
        place_[point] = static_cast<std::uint32_t>(patch.position.size());
        patch.position.push_back(solid.points[point] * size);
        patch.normal.push_back(face.is_round ? math::unit(smooth_[point], normal) : normal);
      }
      patch.index.push_back(place_[point]);
    }
  }
}

}  // namespace seedmesh::building
