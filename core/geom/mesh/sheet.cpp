#include "core/geom/mesh/sheet.h"

#include <array>
#include <map>
#include <vector>

#include "core/base/math.h"
#include "core/model/empty_mesh.h"

namespace seedmesh {
namespace {

/// Joins vertices that are equal in all attributes.
void share_vertices(Mesh& mesh) {
  std::map<std::array<float, 8>, std::uint32_t> first;
  for (std::uint32_t& i : mesh.index.wide) {
    const glm::vec3 p = mesh.position[i], n = mesh.normal[i];
    const glm::vec2 t = mesh.uv[0].empty() ? glm::vec2(0) : mesh.uv[0][i];
    i = first.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y}, i).first->second;
  }
}

}  // namespace

Mesh empty_sheet(const Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  return mesh;
}

void settle_normals(Mesh& mesh) {
  constexpr float least = 0.1F;
  for (int round = 0; round < 4; ++round) {
    bool is_settled = true;
    for (std::size_t i = 0; i + 2 < mesh.index.wide.size(); i += 3) {
      const std::uint32_t* corner = mesh.index.wide.data() + i;
      const glm::vec3 a = mesh.position[corner[0]];
      const glm::vec3 face =
          math::unit(glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a), {0, 0, 1});
      for (int k = 0; k < 3; ++k) {
        glm::vec3& normal = mesh.normal[corner[k]];
        const float over = glm::dot(normal, face);
        if (over >= least) continue;
        is_settled = false;
        normal = math::unit(normal + face * (1.5F * least - over), face) + 0.0F;
      }
    }
    if (is_settled) return;
  }
}

void drop_unused(Mesh& mesh, const Job& job) {
  share_vertices(mesh);
  const Box box = bounds_of(mesh.position.span());
  const glm::vec3 extent = box.max - box.min;
  const float least = 1e-10F * glm::dot(extent, extent);
  Array<std::uint32_t> kept(job);
  for (std::size_t i = 0; i + 2 < mesh.index.wide.size(); i += 3) {
    const std::uint32_t* corner = mesh.index.wide.data() + i;
    const glm::vec3 a = mesh.position[corner[0]],
                    across = glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a);
    if (glm::dot(across, across) > least * least) kept.append({corner, 3});
  }
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> new_index(mesh.position.size(), unused);
  for (const std::uint32_t i : kept) new_index[i] = 0;
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    if (new_index[i] == unused) continue;
    mesh.position[count] = mesh.position[i];
    mesh.normal[count] = mesh.normal[i];
    if (!mesh.uv[0].empty()) mesh.uv[0][count] = mesh.uv[0][i];
    new_index[i] = count++;
  }
  mesh.position.resize(count);
  mesh.normal.resize(count);
  if (!mesh.uv[0].empty()) mesh.uv[0].resize(count);
  for (std::uint32_t& i : kept) i = new_index[i];
  mesh.index.wide = std::move(kept);
}

}  // namespace seedmesh
