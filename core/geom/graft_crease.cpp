#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// A face is folded where it looks so far from the normal of a ring, or from the one that a loop has of two
// limbs: cosines. Folded faces are creased only where twice their area is less than this share of the squared
// radius of the limb that they belong to, or that leaves there: too small to be seen.
constexpr float folded_off_ring = -0.25F, folded_off_loop = -0.6F, largest_fold = 0.5F;
// New vertices of one place share a normal within this cosine.
constexpr float same_normal = 0.999F;

}  // namespace

/// Where limbs meet at a narrow angle no normal is in front of all faces: a crease is what is there. Where
/// the bark is folded the limb must be made otherwise, unless nobody sees it.
bool GraftWriter::can_be_creased(std::uint32_t triangle, std::size_t limb) const {
  const std::uint32_t* corner = mesh_.index.wide.data() + std::size_t{3} * triangle;
  const glm::vec3& at = mesh_.position[corner[0]];
  const glm::vec3 face = glm::cross(mesh_.position[corner[1]] - at, mesh_.position[corner[2]] - at);
  const float square = glm::dot(face, face);
  if (!(square > least_square_of_face())) return false;
  const float size = std::sqrt(square);
  bool is_folded = false;
  float radius = context_.limbs.base_radius[context_.chains.head[limb]];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t group = group_[corner[k]];
    const float least = size * (group == none ? folded_off_ring : folded_off_loop);
    is_folded = is_folded || !(glm::dot(face, mesh_.normal[corner[k]]) > least);
    if (group != none) radius = std::min(radius, loops_[group_limb_[group / 2]].radius);
  }
  return !is_folded || size < largest_fold * radius * radius;
}

/// The creased triangles that are left of all rounds, by their numbers when the limbs stand in order.
std::vector<GraftWriter::Crease> GraftWriter::creases_at_last() const {
  std::vector<std::uint32_t> creased = creased_;
  std::sort(creased.begin(), creased.end());
  creased.erase(std::unique(creased.begin(), creased.end()), creased.end());
  std::vector<Crease> at_last;
  std::uint32_t first = 0;
  for (const Range& range : range_) {
    if (creased.empty()) break;
    const std::uint32_t begin = range.begin.triangle, end = range.end.triangle;
    for (auto each = std::lower_bound(creased.begin(), creased.end(), begin);
         each != creased.end() && *each < end; ++each)
      at_last.push_back({*each - begin + first, first, first + end - begin});
    first += end - begin;
  }
  return at_last;
}

/// Gives these triangles a vertex of their own, with their own normal, for each corner whose normal they look
/// against.
void GraftWriter::write_creases(const std::vector<Crease>& creases, Written& to) const {
  Mesh& mesh = to.mesh;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> made;  // the vertex before, and the new one
  for (const Crease& crease : creases) {
    std::uint32_t* const corner = mesh.index.wide.data() + std::size_t{3} * crease.triangle;
    const std::uint32_t* const begin = mesh.index.wide.data() + std::size_t{3} * crease.first;
    const std::uint32_t* const end = mesh.index.wide.data() + std::size_t{3} * crease.last;
    const glm::vec3 at = mesh.position[corner[0]];
    const glm::vec3 face = glm::cross(mesh.position[corner[1]] - at, mesh.position[corner[2]] - at);
    const glm::vec3 normal = face / std::sqrt(glm::dot(face, face)) + 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t before = corner[k];
      if (glm::dot(normal, mesh.normal[before]) > least_cosine_of_face) continue;
      corner[k] = none;
      if (std::find(begin, end, before) == end) {  // nobody else stands there
        corner[k] = before;
        mesh.normal[before] = normal;
        if (has_tangents()) lay_tangent(mesh, before);
        continue;
      }
      const auto same = std::find_if(made.begin(), made.end(), [&](const auto& each) {
        return each.first == before && glm::dot(mesh.normal[each.second], normal) > same_normal;
      });
      if (same != made.end()) {
        corner[k] = same->second;
        continue;
      }
      corner[k] = static_cast<std::uint32_t>(mesh.position.size());
      made.emplace_back(before, corner[k]);
      mesh.position.push_back(mesh.position[before]);
      mesh.normal.push_back(normal);
      mesh.uv[0].push_back(mesh.uv[0][before]);
      if (has_tangents()) {
        mesh.tangent.push_back(mesh.tangent[before]);
        lay_tangent(mesh, corner[k]);
      }
      to.twin.push_back(1);
      if (context_.options.joints) to.joints.push_back(to.joints[before]);
    }
  }
}

}  // namespace seedmesh
