#include "core/model/levels.h"

#include <algorithm>
#include <array>

namespace seedmesh {

std::size_t levels_of(const Model& model) {
  std::size_t levels = 1;
  for (const Node& node : model.nodes) levels = std::max(levels, 1 + node.lods.size());
  return levels;
}

int mesh_at(const Node& node, std::size_t level) {
  return level == 0 || node.lods.empty() ? node.mesh : node.lods[std::min(level, node.lods.size()) - 1];
}

std::vector<float> screen_shares(const Node& node, std::size_t coarser) {
  constexpr std::array<float, 5> usual = {0.5F, 0.25F, 0.12F, 0.06F, 0.03F};
  constexpr std::size_t of_impostor = 2;
  std::vector<float> shares;
  for (std::size_t i = 0; i < coarser; ++i) {
    const bool is_last = node.has_impostor && i + 1 == coarser;
    if (node.screen.empty()) {
      shares.push_back(usual[std::min(is_last ? std::max(i, of_impostor) : i, usual.size() - 1)]);
    } else {  // an impostor has no share of its own
      shares.push_back(i < node.screen.size() ? node.screen[i]
                                              : std::min(usual[of_impostor], node.screen.back() / 2));
    }
  }
  return shares;
}

std::uint64_t triangles_of(const MeshGroup& group) {
  std::uint64_t triangles = 0;
  for (const Primitive& each : group.primitives) {
    if (each.mesh.topology == Topology::triangles) triangles += each.mesh.elements();
  }
  return triangles;
}

void empty_hidden_meshes(Model& model) {
  std::vector<bool> shown(model.meshes.size(), false);
  for (const Node& node : model.nodes) {
    if (node.mesh >= 0) shown[static_cast<std::size_t>(node.mesh)] = true;
    for (const int lod : node.lods) {
      if (lod >= 0) shown[static_cast<std::size_t>(lod)] = true;
    }
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) model.meshes[i].primitives.clear();
  }
}

}  // namespace seedmesh
