#include "core/gltf/write/object_levels.h"

#include <algorithm>

#include "core/model/build.h"

namespace seedmesh::gltf {

std::vector<std::size_t> parts_of_object(const Model& model) {
  std::vector<std::size_t> parts;
  if (model.nodes.empty() || !model.animations.empty()) return {};
  const Node& root = model.nodes.front();
  if (root.parent >= 0 || root.mesh >= 0) return {};
  const Node* first = nullptr;  // with levels
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.parent != 0) return {};
    if (node.mesh < 0 || node.collision != CollisionShape::none) continue;
    if (!is_identity(node.transform) || !node.instances.transforms.empty() || node.skin >= 0 ||
        !node.extras.empty())
      return {};
    parts.push_back(i);
    if (node.lods.empty()) continue;
    if (first && (node.lods.size() != first->lods.size() || node.screen != first->screen)) return {};
    if (!first) first = &node;
  }
  if (!first || parts.size() < 2) return {};
  return parts;
}

}  // namespace seedmesh::gltf
