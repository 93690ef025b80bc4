#include "core/geom/plant/graft/rib_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/quick_math.h"
#include "core/geom/plant/graft/junction_normals.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;

std::span<const RibSeam> seams_of(const BarkBuffers& bark, std::size_t limb) {
  const auto at = [&](std::uint32_t vertex) {
    return std::lower_bound(bark.rib_seams.begin(), bark.rib_seams.end(), RibSeam{vertex, 0U});
  };
  return {at(bark.range[limb].begin.vertex), at(bark.range[limb].end.vertex)};
}

/// The angle of a triangle at corner k.
float corner_angle(const glm::vec3 (&p)[3], int k) {
  const glm::vec3 one = math::quick_unit(p[(k + 1) % 3] - p[k], glm::vec3{0}),
                  other = math::quick_unit(p[(k + 2) % 3] - p[k], glm::vec3{0});
  const glm::vec3 across = glm::cross(one, other);
  return static_cast<float>(math::quick_atan2(static_cast<double>(std::sqrt(glm::dot(across, across))),
                                              static_cast<double>(glm::dot(one, other))));
}

}  // namespace

bool has_rib_seams(const BarkBuffers& bark, std::size_t limb) { return !seams_of(bark, limb).empty(); }

void smooth_rib_normals(BarkBuffers& bark, std::size_t limb) {
  const LimbRange& range = bark.range[limb];
  const std::uint32_t first = range.begin.vertex, count = range.end.vertex - first;
  std::vector<std::uint32_t> same(count);  // of each vertex, the first one at its position
  std::iota(same.begin(), same.end(), 0U);
  for (const auto& [one, other] : seams_of(bark, limb)) {
    if (other - first < count) same[other - first] = one - first;
  }
  // Each vertex has a pair of groups, as vertices on loops do.
  std::vector<LoopFace> faces;
  std::vector<glm::vec3> sum(count, glm::vec3(0));
  for (std::uint32_t t = range.begin.triangle; t < range.end.triangle; ++t) {
    const std::uint32_t* corner = bark.corners_of(t);
    glm::vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = bark.mesh.position[corner[k]];
    LoopFace& face = faces.emplace_back();
    face.normal = math::quick_unit(glm::cross(p[1] - p[0], p[2] - p[0]), glm::vec3{0});
    for (int k = 0; k < 3; ++k) {
      if (bark.group[corner[k]] != none || corner[k] - first >= count) continue;
      const std::uint32_t vertex = same[corner[k] - first];
      face.group[k] = 2 * vertex;
      sum[vertex] += face.normal * corner_angle(p, k);
    }
  }
  std::vector<GroupNormal> normals(2 * std::size_t{count});
  for (std::size_t i = 0; i < count; ++i) normals[2 * i].set(math::quick_unit(sum[i], glm::vec3{0, 1, 0}));
  relax_normals(faces, normals);
  for (std::size_t i = 0; i < count; ++i) {
    if (bark.group[first + i] != none) continue;
    bark.mesh.normal[first + i] = normals[2 * std::size_t{same[i]}].get() + 0.0F;
    if (bark.has_tangents) level_tangent(bark.mesh, first + i);
  }
}

}  // namespace seedmesh
