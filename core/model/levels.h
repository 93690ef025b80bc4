#pragma once
/// The levels of detail of a model.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Returns the greatest number of levels of any node, the finest included; at least 1.
std::size_t levels_of(const Model& model);

/// Returns the mesh that `node` shows at `level` (0 is the finest), or -1 where it shows none. A node with fewer
/// levels shows its coarsest.
int mesh_at(const Node& node, std::size_t level);

/// Returns one share of the screen's height for each of the `coarser` coarser levels of a node, in descending
/// order. A level is shown below its share, and the coarsest one at any smaller size. An impostor is shown
/// from 12 % of the screen's height at the earliest, because its texture is not sharp enough for larger
/// sizes.
std::vector<float> screen_shares(const Node& node, std::size_t coarser);

/// Returns the name of a mesh at a level: "bark", "bark_LOD1", ...
template <class Integer>
std::string level_name(const std::string& name, Integer level) {
  return level == 0 ? name : name + "_LOD" + std::to_string(level);
}

/// Triangles of all primitives of `group`.
std::uint64_t triangles_of(const MeshGroup& group);

/// Removes the primitives of meshes that no node shows at any level. Indices of meshes stay valid.
void empty_hidden_meshes(Model& model);

}  // namespace seedmesh
