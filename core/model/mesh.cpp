#include "core/model/mesh.h"

#include <algorithm>

namespace seedmesh {

std::size_t Mesh::elements() const {
  const std::size_t corners = index.size() ? index.size() : position.size();
  switch (topology) {
    case Topology::triangles:
      return corners / 3;
    case Topology::lines:
      return corners / 2;
    case Topology::points:
      return corners;
  }
  return 0;
}

Box bounds_of(std::span<const glm::vec3> position) {
  if (position.empty()) return {};
  Box box{position[0], position[0]};
  for (const glm::vec3& p : position) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
  return box;
}

void narrow(Mesh& mesh, const Job& job) {
  if (mesh.index.wide.empty() || mesh.position.size() > 65'535) return;
  Array<std::uint16_t> small(job, mesh.index.wide.size());
  std::transform(mesh.index.wide.begin(), mesh.index.wide.end(), small.begin(),
                 [](std::uint32_t i) { return static_cast<std::uint16_t>(i); });
  mesh.index.small = std::move(small);
  mesh.index.wide = Array<std::uint32_t>(job);
}

}  // namespace seedmesh
