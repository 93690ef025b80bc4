#pragma once
/// The node list of a document, written as text: a scene may have 100,000 nodes.
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// What the nodes of one document show. -1: nothing.
struct Shown {
  std::vector<int> meshes;  ///< for each node of the model, the number of its mesh in the document
  std::vector<int> skins;   ///< for each skin of the model, its number in the document
};

/// Appends the JSON array of all nodes: first those of the model, in its order, then the copies that stand
/// for instances, as children of their node and named after it ("window_0"), all of them sharing its mesh.
/// Identity transforms are left out. Spends the bytes of the text from `job`.
void append_nodes(std::string& out, const Model& model, const Shown& shown, Job& job);

}  // namespace seedmesh::gltf
