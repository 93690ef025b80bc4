#include "core/geom/mesh/box_uv.h"

#include <array>
#include <cmath>

#include "core/geom/mesh/finish.h"
#include "core/model/index_width.h"

namespace seedmesh {
namespace {

constexpr std::size_t directions = 6;  ///< +X, -X, +Y, -Y, +Z, -Z
constexpr std::uint32_t none = ~0U;

/// The direction that a face looks in.
std::size_t direction_of(const glm::vec3& normal) {
  const glm::vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * static_cast<std::size_t>(axis) + (normal[axis] < 0 ? 1 : 0);
}

/// u to the right and v down, as seen from outside.
glm::vec2 projected(const glm::vec3& p, std::size_t direction) {
  switch (direction) {
    case 0:
      return {-p.z, -p.y};
    case 1:
      return {p.z, -p.y};
    case 2:
      return {p.x, p.z};
    case 3:
      return {p.x, -p.z};
    case 4:
      return {p.x, -p.y};
    default:
      return {-p.x, -p.y};
  }
}

template <class T>
void repeat(Array<T>& values, std::size_t vertex) {
  if (values.empty()) return;
  const T value = values[vertex];
  values.push_back(value);
}

/// Appends a copy of a vertex, without uv[0]. Returns its number.
std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t vertex) {
  const auto copy = static_cast<std::uint32_t>(mesh.position.size());
  repeat(mesh.position, vertex);
  repeat(mesh.normal, vertex);
  for (std::size_t set = 1; set < mesh.uv.size(); ++set) repeat(mesh.uv[set], vertex);
  repeat(mesh.color, vertex);
  repeat(mesh.tangent, vertex);
  repeat(mesh.joints, vertex);
  repeat(mesh.weights, vertex);
  repeat(mesh.bone, vertex);
  return copy;
}

using Copies = std::array<Array<std::uint32_t>, directions>;

/// A copy of a vertex for another direction that has the same coordinates; `none` if there is none.
std::uint32_t equal_copy(const Copies& others, std::uint32_t vertex, const glm::vec2& uv, const Mesh& mesh) {
  for (const Array<std::uint32_t>& copies : others) {
    if (copies.empty() || copies[vertex] == none) continue;
    if (mesh.uv[0][copies[vertex]] == uv) return copies[vertex];
  }
  return none;
}

void add_box_coordinates(Mesh& mesh, const Job& job) {
  constexpr std::size_t check_every = 12'288;
  const std::size_t before = mesh.position.size();
  Array<std::uint8_t> first(job, before, std::uint8_t{directions});  // the direction of the vertex itself
  Copies others;                                                     // copies for further directions
  mesh.uv[0] = Array<glm::vec2>(job, before, glm::vec2(0));
  Array<std::uint32_t>& index = mesh.index.wide;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    if (i % check_every == 0) job.check();
    const glm::vec3 &a = mesh.position[index[i]], &b = mesh.position[index[i + 1]],
                    &c = mesh.position[index[i + 2]];
    const std::size_t direction = direction_of(glm::cross(b - a, c - a));
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      const std::uint32_t vertex = index[corner];
      if (first[vertex] == directions) {
        first[vertex] = static_cast<std::uint8_t>(direction);
        mesh.uv[0][vertex] = projected(mesh.position[vertex], direction) + 0.0F;
      }
      if (first[vertex] == direction) continue;
      const glm::vec2 uv = projected(mesh.position[vertex], direction) + 0.0F;
      if (mesh.uv[0][vertex] == uv)
        continue;  // two directions can give one projection, for example where x = z
      Array<std::uint32_t>& copies = others[direction];
      if (copies.empty()) copies = Array<std::uint32_t>(job, before, none);
      if (copies[vertex] == none) copies[vertex] = equal_copy(others, vertex, uv, mesh);
      if (copies[vertex] == none) {
        copies[vertex] = copy_vertex(mesh, vertex);
        mesh.uv[0].push_back(uv);
      }
      index[corner] = copies[vertex];
    }
  }
  if (mesh.position.size() == before) return;
  mesh.cache_ordered = false;  // the copies stand at the end of the vertices
  order_for_cache(mesh, job);
}

bool lacks_coordinates(const Mesh& mesh) {
  return mesh.topology == Topology::triangles && !mesh.packed && mesh.uv[0].empty() && !mesh.position.empty();
}

}  // namespace

void add_box_coordinates(Model& model, Job& job) {
  bool is_wide = false;
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      if (!lacks_coordinates(primitive.mesh)) continue;
      if (!is_wide) widen(model, job);
      is_wide = true;
      add_box_coordinates(primitive.mesh, job);
    }
  }
}

}  // namespace seedmesh
