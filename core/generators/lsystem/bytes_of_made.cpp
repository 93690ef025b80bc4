#include "core/generators/lsystem/build_model.h"
#include "core/texture/file_size.h"

namespace seedmesh::lsystem {

std::uint64_t bytes_of_made(const Model& model, const Demand& demand) {
  constexpr std::uint64_t document_bytes = 400, primitive_bytes = 500;  // JSON
  constexpr std::uint64_t coordinate_bytes = 8, tangent_bytes = 16;     // of a vertex
  texture::TextureSizes textures;
  for (const Material& material : model.materials) textures.add(material);
  std::uint64_t bytes = document_bytes + textures.bytes(demand.textures);
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      const Mesh& mesh = primitive.mesh;
      const std::uint64_t vertices = mesh.position.size();
      const bool is_textured =
          primitive.material >= 0 && demand.textures > 0 &&
          !model.materials[static_cast<std::size_t>(primitive.material)].recipe.kind.empty();
      bytes += primitive_bytes + mesh.bytes();
      if (mesh.uv[0].empty() && mesh.topology == Topology::triangles) bytes += coordinate_bytes * vertices;
      if (is_textured && demand.tangents) bytes += tangent_bytes * vertices;
      if (vertices <= 65'535) bytes -= mesh.index.wide.bytes() / 2;  // indices will have 16 bits
    }
  }
  return bytes;
}

}  // namespace seedmesh::lsystem
