#include "core/generators/city/merged_copies.h"

#include <utility>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

constexpr std::size_t most_vertices = 65'535;

Mesh empty_mesh(bool has_uv, bool has_color, const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  if (has_uv) mesh.uv[0] = Array<glm::vec2>(job);
  if (has_color) mesh.color = Array<glm::u8vec4>(job);
  return mesh;
}

/// Frees what the arrays of a finished mesh do not use.
void trim(Mesh& mesh) {
  mesh.position.shrink_to_fit();
  mesh.normal.shrink_to_fit();
  mesh.uv[0].shrink_to_fit();
  mesh.color.shrink_to_fit();
  mesh.index.wide.shrink_to_fit();
}

}  // namespace

void MergedCopies::add(const Mesh& from, int material, const Transform& at, std::uint32_t chunk) {
  if (from.topology != Topology::triangles || from.elements() == 0) return;
  const bool has_uv = !from.uv[0].empty(), has_color = !from.color.empty();
  std::vector<Mesh>& meshes = meshes_[{chunk, material, has_uv, has_color}];
  if (meshes.empty() || meshes.back().position.size() + from.position.size() > most_vertices) {
    if (!meshes.empty()) trim(meshes.back());
    meshes.push_back(empty_mesh(has_uv, has_color, job_));
  }
  Mesh& to = meshes.back();
  const auto first = static_cast<std::uint32_t>(to.position.size());
  const glm::dmat3 turn(glm::mat3_cast(glm::dquat(at.rotation)));
  const glm::dvec3 scale(at.scale), shift(at.translation);
  for (const glm::vec3& p : from.position)
    to.position.push_back(glm::vec3(turn * (glm::dvec3(p) * scale) + shift) + 0.0F);
  for (const glm::vec3& n : from.normal)
    to.normal.push_back(glm::vec3(math::unit(turn * (glm::dvec3(n) / scale), {0, 1, 0})) + 0.0F);
  if (has_uv) to.uv[0].append(from.uv[0].span());
  if (has_color) to.color.append(from.color.span());
  for (std::size_t i = 0; i < from.index.size(); ++i) to.index.wide.push_back(first + from.index.at(i));
}

void MergedCopies::write(Model& model, ChunkNodes& nodes, const char* group, const char* name) {
  for (auto& [key, meshes] : meshes_) {
    for (Mesh& mesh : meshes) {
      job_.check();
      trim(mesh);
      MeshGroup all;
      all.name = name;
      Primitive primitive;
      primitive.mesh = std::move(mesh);
      primitive.material = std::get<1>(key);
      all.primitives.push_back(std::move(primitive));
      const int node = add_node(model, name, nodes.group(std::get<0>(key), group));
      model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(std::move(all));
    }
  }
  meshes_.clear();
}

}  // namespace seedmesh::city
