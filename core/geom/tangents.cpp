#include "core/geom/tangents.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

/// Some direction at right angles to a unit vector.
glm::vec3 any_across(const glm::vec3& normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return math::unit(glm::cross(normal, axis), {0, 0, 1});
}

/// math::unit, here inline; `otherwise` is asked only when it is needed.
template <class Otherwise>
glm::vec3 unit_or(const glm::vec3& v, const Otherwise& otherwise) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return otherwise();
  const glm::vec3 scaled = v / largest;
  return scaled / std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
}

/// Along u and along v, summed over the triangles at a vertex.
struct Sums {
  glm::vec3 u{0}, v{0};
};

template <class Index>
void sum_up(const Mesh& mesh, const Array<Index>& index, const Array<glm::vec2>& uv, Array<Sums>& sums,
            const Job& job) {
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    if (i % 3072 == 0) job.check();
    const Index corner[3] = {index[i], index[i + 1], index[i + 2]};
    const glm::vec3 a = mesh.position[corner[1]] - mesh.position[corner[0]];
    const glm::vec3 b = mesh.position[corner[2]] - mesh.position[corner[0]];
    const glm::vec2 s = uv[corner[1]] - uv[corner[0]], t = uv[corner[2]] - uv[corner[0]];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0) continue;
    // Not divided by the area in the picture but by its sign: large triangles count more.
    const float sign = area < 0 ? -1.0F : 1.0F;
    const glm::vec3 along_u = (a * t.y - b * s.y) * sign, along_v = (b * s.x - a * t.x) * sign;
    for (const Index k : corner) {
      sums[k].u += along_u;
      sums[k].v += along_v;
    }
  }
}

void add_tangents(Mesh& mesh, const Array<glm::vec2>& uv, const Job& job) {
  const std::size_t vertices = mesh.position.size();
  Array<Sums> sums(job, vertices, Sums{});
  if (mesh.index.small.empty()) {
    sum_up(mesh, mesh.index.wide, uv, sums, job);
  } else {
    sum_up(mesh, mesh.index.small, uv, sums, job);
  }
  mesh.tangent = Array<glm::vec4>(job, vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    const glm::vec3 normal = mesh.normal[i], sum = sums[i].u;
    const glm::vec3 flat = sum - normal * glm::dot(normal, sum);
    const bool is_none = glm::dot(flat, flat) <= 1e-8F * glm::dot(sum, sum);
    const auto across = [&] { return any_across(normal); };
    const glm::vec3 tangent = is_none ? across() : unit_or(flat, across);
    // v grows down the picture, and the bitangent points up it.
    const float w = glm::dot(glm::cross(normal, tangent), sums[i].v) > 0 ? -1.0F : 1.0F;
    mesh.tangent[i] = glm::vec4(tangent, w);
  }
}

}  // namespace

void add_tangents(Model& model, const Job& job) {
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      Mesh& mesh = primitive.mesh;
      if (primitive.material < 0 || mesh.topology != Topology::triangles || mesh.normal.empty()) continue;
      const TextureUse& map = model.materials[static_cast<std::size_t>(primitive.material)].normal_texture;
      if (map.texture < 0 || !mesh.tangent.empty()) continue;
      const auto& uv = mesh.uv[static_cast<std::size_t>(map.uv_set)];
      if (!uv.empty()) add_tangents(mesh, uv, job);
    }
  }
}

}  // namespace seedmesh
