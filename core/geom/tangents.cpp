#include "core/geom/tangents.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/math.h"
#include "core/geom/four.h"

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

glm::vec4 tangent_of(const glm::vec3& normal, const Sums& sums) {
  const glm::vec3 flat = sums.u - normal * glm::dot(normal, sums.u);
  const bool is_none = glm::dot(flat, flat) <= 1e-8F * glm::dot(sums.u, sums.u);
  const auto across = [&] { return any_across(normal); };
  const glm::vec3 tangent = is_none ? across() : unit_or(flat, across);
  // v grows down the picture, and the bitangent points up it.
  const float w = glm::dot(glm::cross(normal, tangent), sums.v) > 0 ? -1.0F : 1.0F;
  return {tangent, w};
}

/// tangent_of() four vertices at once; false: one of them has no direction of its own.
bool write_four(const glm::vec3* normals, const Sums* sums, glm::vec4* out) {
  const Four n(normals, Four::size);
  Four u, v, flat;
  alignas(16) float largest[Four::size], length[Four::size], sign[Four::size];
  for (std::size_t k = 0; k < Four::size; ++k) {
    u.x[k] = sums[k].u.x;
    u.y[k] = sums[k].u.y;
    u.z[k] = sums[k].u.z;
    v.x[k] = sums[k].v.x;
    v.y[k] = sums[k].v.y;
    v.z[k] = sums[k].v.z;
  }
  int good = 0;
  for (std::size_t k = 0; k < Four::size; ++k) {
    const float over = n.x[k] * u.x[k] + n.y[k] * u.y[k] + n.z[k] * u.z[k];
    flat.x[k] = u.x[k] - n.x[k] * over;
    flat.y[k] = u.y[k] - n.y[k] * over;
    flat.z[k] = u.z[k] - n.z[k] * over;
    const float a = std::abs(flat.x[k]), b = std::abs(flat.y[k]), c = std::abs(flat.z[k]);
    const float more = a < b ? b : a;
    largest[k] = more < c ? c : more;
    const float square = flat.x[k] * flat.x[k] + flat.y[k] * flat.y[k] + flat.z[k] * flat.z[k];
    const float whole = u.x[k] * u.x[k] + u.y[k] * u.y[k] + u.z[k] * u.z[k];
    good += square > 1e-8F * whole && largest[k] > 0 && largest[k] <= std::numeric_limits<float>::max() ? 1 : 0;
  }
  if (good != static_cast<int>(Four::size)) return false;
  for (std::size_t k = 0; k < Four::size; ++k) {
    flat.x[k] /= largest[k];
    flat.y[k] /= largest[k];
    flat.z[k] /= largest[k];
    length[k] = std::sqrt(flat.x[k] * flat.x[k] + flat.y[k] * flat.y[k] + flat.z[k] * flat.z[k]);
    flat.x[k] /= length[k];
    flat.y[k] /= length[k];
    flat.z[k] /= length[k];
    const float side = (n.y[k] * flat.z[k] - flat.y[k] * n.z[k]) * v.x[k] +
                       (n.z[k] * flat.x[k] - flat.z[k] * n.x[k]) * v.y[k] +
                       (n.x[k] * flat.y[k] - flat.x[k] * n.y[k]) * v.z[k];
    sign[k] = side > 0 ? -1.0F : 1.0F;
  }
  for (std::size_t k = 0; k < Four::size; ++k) out[k] = {flat.x[k], flat.y[k], flat.z[k], sign[k]};
  return true;
}

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
  for (std::size_t i = 0; i < vertices; i += Four::size) {
    if (i + Four::size <= vertices &&
        write_four(mesh.normal.data() + i, sums.data() + i, mesh.tangent.data() + i))
      continue;
    const std::size_t end = std::min(i + Four::size, vertices);
    for (std::size_t k = i; k < end; ++k) mesh.tangent[k] = tangent_of(mesh.normal[k], sums[k]);
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
