#include "core/generators/estimate.h"

#include "core/texture/file_size.h"

namespace seedmesh {

std::uint64_t image_bytes(const Estimate& estimate) {
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : estimate.images) sum += bytes;
  return sum;
}

void add_images(Estimate& estimate, const std::map<std::string, std::uint64_t>& images) {
  for (const auto& [name, bytes] : images) {
    if (estimate.images.emplace(name, bytes).second) estimate.bytes += bytes;
  }
}

void add_images_of(Estimate& estimate, const Model& model, int size) {
  texture::TextureSizes textures;
  for (const Material& material : model.materials) textures.add(material);
  add_images(estimate, textures.images(size));
  for (const std::shared_ptr<const Image>& image : model.textures) {
    const std::size_t bytes = image->bytes.size();
    add_images(estimate, {{"given " + image->name + ' ' + std::to_string(bytes), bytes}});
  }
}

void add_bytes(Estimate& sum, const Estimate& part) {
  sum.bytes += part.bytes - image_bytes(part);
  add_images(sum, part.images);
}

Estimate estimate_of_made(const Model& model, const Demand& demand) {
  constexpr std::uint64_t document_bytes = 400, primitive_bytes = 500;  // JSON
  constexpr std::uint64_t coordinate_bytes = 8, tangent_bytes = 16;     // of a vertex
  Estimate estimate{count(model).triangles, document_bytes, false};
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      const Mesh& mesh = primitive.mesh;
      const std::uint64_t vertices = mesh.position.size();
      const bool needs_tangents =
          primitive.material >= 0 && demand.textures > 0 && demand.tangents &&
          texture::has_normals(model.materials[static_cast<std::size_t>(primitive.material)].recipe);
      estimate.bytes += primitive_bytes + mesh.bytes();
      if (mesh.uv[0].empty() && mesh.topology == Topology::triangles)
        estimate.bytes += coordinate_bytes * vertices;
      if (needs_tangents) estimate.bytes += tangent_bytes * vertices;
      if (vertices <= 65'535) estimate.bytes -= mesh.index.wide.bytes() / 2;  // indices will have 16 bits
    }
  }
  add_images_of(estimate, model, demand.textures);
  return estimate;
}

}  // namespace seedmesh
