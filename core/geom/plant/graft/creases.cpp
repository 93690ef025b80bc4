#include "core/geom/plant/graft/creases.h"

#include <algorithm>
#include <cmath>

#include "core/geom/plant/graft/face_check.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
// A face is folded where its cosine to the normal of a ring, or to that of a loop, is below these. A folded
// face is creased where twice its area is less than this share of the squared radius of the limbs that it
// touches.
constexpr float folded_off_ring = -0.25F, folded_off_loop = -0.6F, largest_fold = 0.5F;
// New vertices at one position share a normal within this cosine.
constexpr float same_normal = 0.999F;

/// The cross product of two sides: across the face, with the length of twice its area.
glm::vec3 across(const Mesh& mesh, const std::uint32_t* corner) {
  const glm::vec3& at = mesh.position[corner[0]];
  return glm::cross(mesh.position[corner[1]] - at, mesh.position[corner[2]] - at);
}

/// A copy of a vertex with another normal.
std::uint32_t copy_vertex(JoinedBark& bark, std::uint32_t vertex, const glm::vec3& normal) {
  Mesh& mesh = bark.mesh;
  const auto copy = static_cast<std::uint32_t>(mesh.position.size());
  mesh.position.push_back(mesh.position[vertex]);
  mesh.normal.push_back(normal);
  mesh.uv[0].push_back(mesh.uv[0][vertex]);
  if (!mesh.tangent.empty()) {
    mesh.tangent.push_back(mesh.tangent[vertex]);
    level_tangent(mesh, copy);
  }
  bark.twin.push_back(1);
  if (!bark.joints.empty()) bark.joints.push_back(bark.joints[vertex]);
  return copy;
}

}  // namespace

bool can_be_creased(const GraftInput& in, const BarkBuffers& bark, std::uint32_t triangle, std::size_t limb) {
  const std::uint32_t* corner = bark.corners_of(triangle);
  const glm::vec3 face = across(bark.mesh, corner);
  const float square = glm::dot(face, face);
  if (!(square > least_face_square(in.scale.size))) return false;
  const float size = std::sqrt(square);
  bool is_folded = false;
  float radius = in.limbs.base_radius[in.chains.head[limb]];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t group = bark.group[corner[k]];
    const float least = size * (group == none ? folded_off_ring : folded_off_loop);
    is_folded = is_folded || !(glm::dot(face, bark.mesh.normal[corner[k]]) > least);
    if (group != none) radius = std::min(radius, bark.loops[bark.group_limb[group / 2]].radius);
  }
  return !is_folded || size < largest_fold * radius * radius;
}

std::vector<Crease> remaining_creases(const BarkBuffers& bark, std::vector<std::uint32_t> creased) {
  std::sort(creased.begin(), creased.end());
  creased.erase(std::unique(creased.begin(), creased.end()), creased.end());
  std::vector<Crease> remaining;
  std::uint32_t first = 0;
  for (const LimbRange& range : bark.range) {
    if (creased.empty()) break;
    const std::uint32_t begin = range.begin.triangle, end = range.end.triangle;
    for (auto each = std::lower_bound(creased.begin(), creased.end(), begin);
         each != creased.end() && *each < end; ++each)
      remaining.push_back({*each - begin + first, first, first + end - begin});
    first += end - begin;
  }
  return remaining;
}

void write_creases(const std::vector<Crease>& creases, JoinedBark& bark) {
  Mesh& mesh = bark.mesh;
  struct Copy {
    std::uint32_t from, to;
  };
  std::vector<Copy> copies;
  for (const Crease& crease : creases) {
    std::uint32_t* const corner = mesh.index.wide.data() + std::size_t{3} * crease.triangle;
    const std::uint32_t* const begin = mesh.index.wide.data() + std::size_t{3} * crease.first;
    const std::uint32_t* const end = mesh.index.wide.data() + std::size_t{3} * crease.last;
    const glm::vec3 face = across(mesh, corner);
    const glm::vec3 normal = face / std::sqrt(glm::dot(face, face)) + 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t before = corner[k];
      if (glm::dot(normal, mesh.normal[before]) > least_face_cosine) continue;
      corner[k] = none;
      const auto same = std::find_if(copies.begin(), copies.end(), [&](const Copy& copy) {
        return copy.from == before && glm::dot(mesh.normal[copy.to], normal) > same_normal;
      });
      if (std::find(begin, end, before) == end) {  // no other triangle has the vertex
        corner[k] = before;
        mesh.normal[before] = normal;
        if (!mesh.tangent.empty()) level_tangent(mesh, before);
      } else if (same != copies.end()) {
        corner[k] = same->to;
      } else {
        corner[k] = copy_vertex(bark, before, normal);
        copies.push_back({before, corner[k]});
      }
    }
  }
}

}  // namespace seedmesh
