#pragma once
/// The node list of a document, written as text: a scene may have 100,000 nodes.
#include <map>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// The accessors of a node's copies in EXT_mesh_gpu_instancing. -1: all are alike in this.
struct CopyAccessors {
  int translation = -1, rotation = -1, scale = -1;
};

/// What the nodes of one document show. -1: nothing.
struct Shown {
  std::vector<int> meshes;             ///< for each node of the model, the number of its mesh in the document
  std::vector<std::vector<int>> lods;  ///< and those of its coarser levels; empty unless they are inside
  std::vector<int> skins;              ///< for each skin of the model, its number in the document
  std::map<std::size_t, CopyAccessors> copies;  ///< nodes whose copies are no nodes
};

/// Appends the JSON array of all nodes: first those of the model, in its order, then the copies that stand
/// for instances, as children of their node and named after it ("window_0"), all of them sharing its mesh,
/// and last the coarser levels ("bark_LOD1") of both kinds, which MSFT_lod names and no scene shows. Identity
/// transforms are left out. Spends the bytes of the text from `job`.
void append_nodes(std::string& out, const Model& model, const Shown& shown, Job& job);

}  // namespace seedmesh::gltf
