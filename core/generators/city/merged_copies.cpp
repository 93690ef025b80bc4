#include "core/generators/city/merged_copies.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/math.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::city {
namespace {

constexpr std::size_t most_vertices = 65'535;

Mesh mesh_with(bool has_uv, bool has_color, const Job& job) {
  Mesh mesh = empty_mesh(job);
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

/// Appends a mesh that is moved by `moved` first and then placed. Both steps round to single precision.
void append(const Mesh& from, const Transform& at, Mesh& to, const std::optional<glm::dvec3>& moved = {}) {
  const auto first = static_cast<std::uint32_t>(to.position.size());
  const glm::dmat3 turn(glm::mat3_cast(glm::dquat(at.rotation)));
  const glm::dvec3 scale(at.scale), shift(at.translation);
  const auto place = [&](const glm::vec3& p) {
    return glm::vec3(turn * (glm::dvec3(p) * scale) + shift) + 0.0F;
  };
  const auto turned = [&](const glm::vec3& n) {
    return glm::vec3(math::unit(turn * (glm::dvec3(n) / scale), {0, 1, 0})) + 0.0F;
  };
  for (const glm::vec3& p : from.position)
    to.position.push_back(place(moved ? glm::vec3(glm::dvec3(p) + *moved) + 0.0F : p));
  for (const glm::vec3& n : from.normal)
    to.normal.push_back(turned(moved ? glm::vec3(math::unit(glm::dvec3(n), {0, 1, 0})) + 0.0F : n));
  to.uv[0].append(from.uv[0].span());
  to.color.append(from.color.span());
  for (std::size_t i = 0; i < from.index.size(); ++i) to.index.wide.push_back(first + from.index.at(i));
}

/// A primitive with the translation of its node.
struct Shown {
  const Primitive* primitive;
  glm::dvec3 shift;
};

bool is_translation(const Transform& at) {
  Transform turned = at;
  turned.translation = glm::vec3(0);
  return is_identity(turned);
}

/// Lists the primitives of all nodes. Returns false if one of them is not simply moved.
bool list_shown(const Model& model, std::vector<Shown>& shown) {
  std::vector<glm::dvec3> shifts;
  for (const Node& node : model.nodes) {
    if (!is_translation(node.transform) || !node.instances.transforms.empty() || node.skin >= 0) return false;
    const glm::dvec3 own(node.transform.translation);
    shifts.push_back(node.parent < 0 ? own : shifts[static_cast<std::size_t>(node.parent)] + own);
    if (node.mesh < 0) continue;
    for (const Primitive& each : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (each.mesh.elements() == 0) continue;
      const bool is_plain = each.material >= 0 && each.mesh.topology == Topology::triangles &&
                            each.mesh.normal.size() == each.mesh.position.size();
      if (!is_plain) return false;
      shown.push_back({&each, shifts.back()});
    }
  }
  return true;
}

}  // namespace

Mesh& MergedCopies::mesh_for(const Mesh& from, std::size_t vertices, int material, std::uint32_t chunk) {
  const bool has_uv = !from.uv[0].empty(), has_color = !from.color.empty();
  std::vector<Mesh>& meshes = meshes_[{chunk, material, has_uv, has_color}];
  if (meshes.empty() || meshes.back().position.size() + vertices > most_vertices) {
    if (!meshes.empty()) trim(meshes.back());
    meshes.push_back(mesh_with(has_uv, has_color, job_));
  }
  return meshes.back();
}

void MergedCopies::add(const Mesh& from, int material, const Transform& at, std::uint32_t chunk) {
  if (from.topology != Topology::triangles || from.elements() == 0) return;
  append(from, at, mesh_for(from, from.position.size(), material, chunk));
}

bool MergedCopies::add_nodes(const Model& model, const std::vector<int>& materials, const Transform& at,
                             std::uint32_t chunk) {
  std::vector<Shown> shown;
  if (!list_shown(model, shown)) return false;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const int own = shown[i].primitive->material;
    const auto is_same = [own](const Shown& other) { return other.primitive->material == own; };
    if (std::any_of(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(i), is_same)) continue;
    std::size_t vertices = 0;
    for (const Shown& each : shown) vertices += is_same(each) ? each.primitive->mesh.position.size() : 0;
    Mesh& to = mesh_for(shown[i].primitive->mesh, vertices, materials[static_cast<std::size_t>(own)], chunk);
    for (const Shown& each : shown) {
      if (is_same(each)) append(each.primitive->mesh, at, to, each.shift);
    }
  }
  return true;
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
      const int node = city::add_node(model, name, nodes.group(std::get<0>(key), group));
      model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(std::move(all));
    }
  }
  meshes_.clear();
}

}  // namespace seedmesh::city
