#pragma once
/// The node list of a document as text: a scene may have 100,000 nodes.
#include <map>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// The accessors of a node's copies in EXT_mesh_gpu_instancing. -1: all copies have the default value of
/// glTF.
struct CopyAccessors {
  int translation = -1, rotation = -1, scale = -1;
};

/// The meshes and skins that the nodes of one document show. -1: none.
struct NodeMeshes {
  std::vector<int> meshes;  ///< for each node of the model, the number of its mesh in the document
  std::vector<std::vector<int>>
      lods;                ///< the same for its coarser levels; empty without Dialect::lods_inside
  std::vector<int> skins;  ///< for each skin of the model, its number in the document
  std::map<std::size_t, CopyAccessors> copies;  ///< for nodes whose copies are arrays
  /// For each node the number of its shape in OMI_physics_shape, or -1; empty without Dialect::physics.
  std::vector<int> shapes;
  std::vector<int> shape_meshes;  ///< for each shape its mesh in the document
  bool exact = false;             ///< translations and scales are written as doubles, without rounding
  /// The parts of an object whose root has the levels (object_levels.h), or empty.
  std::vector<std::size_t> parts;
};

/// Appends the JSON array of all nodes. First come the nodes of the model in their order. Then come the
/// copies of nodes as their children ("window_0"), which share the mesh. Last come the coarser levels of both
/// ("bark_LOD1"), to which MSFT_lod refers and which are in no scene. Those of an object are grouped below a
/// node for each level ("oak_LOD1"). Identity transforms are left out. Spends the bytes of the text from
/// `job`.
void append_nodes(std::string& out, const Model& model, const NodeMeshes& shown, Job& job);

}  // namespace seedmesh::gltf
