#pragma once
/// Joins the meshes of those models that occur only once. Meshes of the same chunk and material become one mesh.
/// Engines draw few large meshes faster than thousands of small ones, and files are smaller.
#include <map>
#include <tuple>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/city/chunks.h"

namespace seedmesh::city {

/// Collects meshes until write(), by chunk and material.
class MergedCopies {
 public:
  explicit MergedCopies(Job& job) : job_(job) {}

  /// Adds the triangles of a mesh with a material of the city, at a transform without a reflection. Meshes of other
  /// topologies are left out.
  void add(const Mesh& mesh, int material, const Transform& at, std::uint32_t chunk);

  /// Adds the meshes of all nodes of a model. `materials` are those of the city, indexed by those of the model.
  /// Returns false, and adds nothing, if a node has copies, a transform other than a translation, or a mesh without
  /// normals or materials.
  bool add_nodes(const Model& model, const std::vector<int>& materials, const Transform& at,
                 std::uint32_t chunk);

  /// Adds all meshes to the model, each below the node `group` of its chunk.
  void write(Model& model, ChunkNodes& nodes, const char* group, const char* name);

 private:
  /// Returns a mesh with capacity for this number of further vertices.
  Mesh& mesh_for(const Mesh& from, std::size_t vertices, int material, std::uint32_t chunk);

  /// Chunk, material, and which attributes there are.
  using Key = std::tuple<std::uint32_t, int, bool, bool>;

  Job& job_;
  /// Each mesh has at most 65,535 vertices, so that 16-bit indices suffice.
  std::map<Key, std::vector<Mesh>> meshes_;
};

}  // namespace seedmesh::city
