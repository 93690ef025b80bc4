#include "core/gltf/compress/pack.h"

#include <memory>
#include <utility>

#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/gltf/compress/compress.h"
#include "core/gltf/compress/quantize.h"

namespace seedmesh::gltf {
namespace {

/// Textures are added later. Their normal maps require tangents.
bool can_be_packed(const Primitive& primitive, const Model& model) {
  const Mesh& mesh = primitive.mesh;
  if (mesh.packed || mesh.topology != Topology::triangles || mesh.elements() == 0) return false;
  if (primitive.material < 0) return true;
  const Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
  return material.recipe.kind.empty() && (material.normal_texture.texture < 0 || !mesh.tangent.empty());
}

void encode(Column& column, Pool pool, Job& job) {
  if (Bin::has_own_view(column.slice.size())) column.slice = encoded_ahead(column.slice, pool, job);
}

}  // namespace

void pack(Model& model, Job& job) {
  const std::vector<Grid> grids = grids_of(model);
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    for (Primitive& primitive : model.meshes[i].primitives) {
      if (!can_be_packed(primitive, model)) continue;
      Mesh& mesh = primitive.mesh;
      auto packed = std::make_shared<PackedPart>();
      packed->elements = mesh.elements();
      packed->vertices = mesh.vertices();
      packed->bytes = mesh.bytes();
      packed->bounds = bounds_of(mesh);
      Part& part = packed->part;
      std::vector<int> variants = primitive.variant_materials;
      part = take_part(primitive);
      primitive.variant_materials = std::move(variants);
      quantize(part, grids[i], job);
      for (Column& column : part.columns) encode(column, vertex_pool(column), job);
      if (part.index && part.index->count > 0) encode(*part.index, index_pool(*part.index), job);
      part.is_packed = true;
      mesh = Mesh{};
      mesh.packed = std::move(packed);
    }
  }
}

}  // namespace seedmesh::gltf
