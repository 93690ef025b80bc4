#include "core/geom/mesh/split_inward_corners.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh {
namespace {

template <class T>
void repeat(Array<T>& values, std::uint32_t vertex) {
  if (values.empty()) return;
  const T value = values[vertex];
  values.push_back(value);
}

std::uint32_t add_copy(Mesh& mesh, std::uint32_t vertex, const glm::vec3& normal) {
  const auto copy = static_cast<std::uint32_t>(mesh.position.size());
  repeat(mesh.position, vertex);
  mesh.normal.push_back(normal);
  for (Array<glm::vec2>& uv : mesh.uv) repeat(uv, vertex);
  repeat(mesh.color, vertex);
  repeat(mesh.tangent, vertex);
  repeat(mesh.joints, vertex);
  repeat(mesh.weights, vertex);
  repeat(mesh.bone, vertex);
  return copy;
}

/// A corner, as an index into the index array, and the normal of its face.
struct Turned {
  std::size_t corner;
  glm::vec3 normal;
};

std::vector<Turned> corners_facing_inward(const Mesh& mesh, const Job& job) {
  constexpr std::size_t check_interval = 65'536;
  const Array<std::uint32_t>& index = mesh.index.wide;
  std::vector<Turned> found;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    if (i % (3 * check_interval) == 0) job.check();
    const glm::vec3 a = mesh.position[index[i]];
    const glm::vec3 across = glm::cross(mesh.position[index[i + 1]] - a, mesh.position[index[i + 2]] - a);
    const float area = std::sqrt(glm::dot(across, across));
    if (!(area > 0)) continue;
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      if (glm::dot(mesh.normal[index[corner]], across) < 0) found.push_back({corner, across / area});
    }
  }
  return found;
}

}  // namespace

void split_inward_corners(Mesh& mesh, const Job& job) {
  const std::vector<Turned> turned = corners_facing_inward(mesh, job);
  if (turned.empty()) return;
  Array<std::uint32_t> uses(job, mesh.position.size());
  std::ranges::fill(uses, 0U);
  for (const std::uint32_t vertex : mesh.index.wide) ++uses[vertex];
  for (const Turned& each : turned) {
    std::uint32_t& vertex = mesh.index.wide[each.corner];
    // The last user of a vertex keeps it.
    if (--uses[vertex] == 0) {
      mesh.normal[vertex] = each.normal;
    } else {
      vertex = add_copy(mesh, vertex, each.normal);
    }
  }
}

}  // namespace seedmesh
