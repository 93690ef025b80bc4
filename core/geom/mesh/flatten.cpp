#include "core/geom/mesh/flatten.h"

#include <algorithm>
#include <map>

#include "core/base/math.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"

namespace seedmesh {
namespace {

/// One primitive as one node shows it.
struct Shown {
  const Mesh* mesh;
  glm::dmat4 matrix;
};

template <class T>
void append_or_fill(Array<T>& out, const Array<T>& part, std::size_t count, const T& otherwise) {
  if (!part.empty()) {
    out.append(part.span());
    return;
  }
  T* at = out.extend(count);
  std::fill(at, at + count, otherwise);
}

class Join {
 public:
  Join(const std::vector<Shown>& parts, Job& job) : job_(job) {
    mesh_ = empty_mesh(job);
    mesh_.topology = parts.front().mesh->topology;
    mesh_.uv[0] = Array<glm::vec2>(job);
    mesh_.color = Array<glm::u8vec4>(job);
    std::size_t vertices = 0, corners = 0;
    for (const Shown& part : parts) {
      vertices += part.mesh->position.size();
      corners += part.mesh->index.size();
      has_uv_ |= !part.mesh->uv[0].empty();
      has_color_ |= !part.mesh->color.empty();
      has_normal_ |= !part.mesh->normal.empty();
    }
    mesh_.position.reserve(vertices);
    mesh_.index.wide.reserve(corners);
    for (const Shown& part : parts) add(part);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void add(const Shown& part) {
    const Mesh& from = *part.mesh;
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    const std::size_t count = from.position.size();
    const glm::dmat3 linear(part.matrix);
    const double determinant = glm::determinant(linear);
    const glm::dmat3 normal_turn = determinant != 0 ? glm::transpose(glm::inverse(linear)) : linear;
    for (const glm::vec3& p : from.position)
      mesh_.position.push_back(glm::vec3(part.matrix * glm::dvec4(glm::dvec3(p), 1)) + 0.0F);
    for (const glm::vec3& n : from.normal)
      mesh_.normal.push_back(glm::vec3(math::unit(normal_turn * glm::dvec3(n), {0, 1, 0})) + 0.0F);
    if (has_normal_ && from.normal.empty()) append_or_fill(mesh_.normal, from.normal, count, {0, 1, 0});
    if (has_uv_) append_or_fill(mesh_.uv[0], from.uv[0], count, {0, 0});
    if (has_color_) append_or_fill(mesh_.color, from.color, count, {255, 255, 255, 255});
    const bool mirrored = determinant < 0 && from.topology == Topology::triangles;
    for (std::size_t i = 0; i < from.index.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const std::size_t corner = mirrored ? i / 3 * 3 + 2 - i % 3 : i;
      mesh_.index.wide.push_back(first + from.index.at(corner));
    }
  }

  Job& job_;
  Mesh mesh_;
  bool has_uv_ = false, has_color_ = false, has_normal_ = false;
};

}  // namespace

std::vector<Primitive> flatten(const Model& model, Job& job) {
  std::map<std::pair<int, Topology>, std::size_t> number;
  std::vector<std::vector<Shown>> groups;
  std::vector<int> materials;
  const std::vector<glm::dmat4> world = world_matrices(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.mesh < 0) continue;
    std::vector<glm::dmat4> places;
    for (const Transform& copy : node.instances.transforms) places.push_back(world[i] * matrix_of(copy));
    if (places.empty()) places.push_back(world[i]);
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (primitive.mesh.elements() == 0) continue;
      job.spend(Resource::triangles, (places.size() - 1) * primitive.mesh.elements());
      const auto [found, is_new] =
          number.try_emplace({primitive.material, primitive.mesh.topology}, groups.size());
      if (is_new) {
        groups.emplace_back();
        materials.push_back(primitive.material);
      }
      for (const glm::dmat4& place : places) groups[found->second].push_back({&primitive.mesh, place});
    }
  }
  std::vector<Primitive> primitives;
  for (std::size_t i = 0; i < groups.size(); ++i)
    primitives.push_back({Join(groups[i], job).take(), materials[i], {}});
  return primitives;
}

bool fit_unit_box(std::vector<Primitive>& primitives) {
  Box all;
  bool any = false;
  for (const Primitive& primitive : primitives) {
    if (primitive.mesh.position.empty()) continue;
    const Box box = bounds_of(primitive.mesh.position.span());
    all = any ? Box{glm::min(all.min, box.min), glm::max(all.max, box.max)} : box;
    any = true;
  }
  const glm::dvec3 size = glm::dvec3(all.max) - glm::dvec3(all.min);
  const double longest = std::max({size.x, size.y, size.z});
  if (!any || !(longest > 0)) return false;
  const glm::dvec3 middle = (glm::dvec3(all.max) + glm::dvec3(all.min)) / 2.0;
  for (Primitive& primitive : primitives) {
    for (glm::vec3& p : primitive.mesh.position) p = glm::vec3((glm::dvec3(p) - middle) / longest);
  }
  return true;
}

}  // namespace seedmesh
