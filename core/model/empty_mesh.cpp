#include "core/model/empty_mesh.h"

namespace seedmesh {

Mesh empty_mesh(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

}  // namespace seedmesh
