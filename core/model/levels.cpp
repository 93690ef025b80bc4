#include "core/model/levels.h"

#include <algorithm>

namespace seedmesh {

std::size_t levels_of(const Model& model) {
  std::size_t levels = 1;
  for (const Node& node : model.nodes) levels = std::max(levels, 1 + node.lods.size());
  return levels;
}

int mesh_at(const Node& node, std::size_t level) {
  return level == 0 || node.lods.empty() ? node.mesh : node.lods[std::min(level, node.lods.size()) - 1];
}

std::uint64_t triangles_of(const MeshGroup& group) {
  std::uint64_t triangles = 0;
  for (const Primitive& each : group.primitives) {
    if (each.mesh.topology == Topology::triangles) triangles += each.mesh.elements();
  }
  return triangles;
}

}  // namespace seedmesh
