#include "core/geom/outward.h"

#include <cmath>

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

}  // namespace

void turn_outward(Mesh& mesh, const Job& job) {
  constexpr std::size_t look_every = 65'536;
  Array<std::uint32_t>& index = mesh.index.wide;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    if (i % (3 * look_every) == 0) job.check();
    const glm::vec3 a = mesh.position[index[i]];
    const glm::vec3 across = glm::cross(mesh.position[index[i + 1]] - a, mesh.position[index[i + 2]] - a);
    const float area = std::sqrt(glm::dot(across, across));
    if (!(area > 0)) continue;
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      if (glm::dot(mesh.normal[index[corner]], across) < 0)
        index[corner] = add_copy(mesh, index[corner], across / area);
    }
  }
}

}  // namespace seedmesh
