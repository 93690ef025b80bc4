#include "core/model/index_width.h"

#include <algorithm>

namespace seedmesh {

void widen(Model& model, const Job& job) {
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      Indices& index = primitive.mesh.index;
      if (index.small.empty()) continue;
      job.check();
      index.wide = Array<std::uint32_t>(job, index.small.size());
      std::copy(index.small.begin(), index.small.end(), index.wide.begin());
      index.small = Array<std::uint16_t>(job);
    }
  }
}

void check_vertex_count(const Job& job, std::uint64_t vertices, std::string_view what) {
  constexpr std::uint64_t most = 0xFFFFFFFEU;  // the greatest index is reserved
  if (vertices <= most) return;
  job.refuse(limit_issue({Resource::vertices, most, vertices},
                         std::string(what) + " would have more vertices than 32-bit indices can address"));
}

namespace {

template <class T>
void copy(const Array<T>& from, Array<T>& to) {
  to = from.template empty_array_of<T>();
  to.append(from.span());
}

}  // namespace

Mesh copy_of(const Mesh& mesh) {
  Mesh out;
  out.topology = mesh.topology;
  copy(mesh.position, out.position);
  copy(mesh.normal, out.normal);
  for (std::size_t i = 0; i < mesh.uv.size(); ++i) copy(mesh.uv[i], out.uv[i]);
  copy(mesh.color, out.color);
  copy(mesh.tangent, out.tangent);
  copy(mesh.joints, out.joints);
  copy(mesh.weights, out.weights);
  copy(mesh.bone, out.bone);
  copy(mesh.next_position, out.next_position);
  copy(mesh.index.wide, out.index.wide);
  copy(mesh.index.small, out.index.small);
  out.bounds = mesh.bounds;
  out.cache_ordered = mesh.cache_ordered;
  return out;
}

}  // namespace seedmesh
