#pragma once
/// The leaves of a tree as meshes or places.
#include <optional>

#include "core/generators/tree/growth_context.h"
#include "core/generators/tree/levels.h"
#include "core/generators/tree/looks.h"
#include "core/geom/organs.h"

namespace seedmesh::tree {

/// What moves leaves: bones of the joints, wind; both may be empty.
struct LeafMotion {
  std::span<const std::uint16_t> bones;
  const WindField* wind = nullptr;
};

/// The mesh of one leaf, 1 long.
Mesh leaf_of(const TreeParams& params, int level, const Job& job);

/// Leaves only those that are drawn, and gives them the size of the mesh.
void fit_leaves(Organs& organs, const TreeParams& params, const Job& job);

/// Leaves that were fitted; `model_size` is the diagonal of the tree. Borrowed.
struct Leaves {
  const Organs& organs;
  const TreeParams& params;
  const LeafMotion& motion;
  float model_size;
};

/// A level of leaves that are not places of one mesh, made in two steps as OrganPlacing does.
class LeafPlacing {
 public:
  LeafPlacing(const Leaves& leaves, const Organs& organs, int level, Job& job);
  LeafPlacing(const LeafPlacing&) = delete;
  LeafPlacing& operator=(const LeafPlacing&) = delete;
  void write() { placing_.write(); }
  std::vector<Foliage> take() { return placing_.take(); }

 private:
  Mesh surface_;
  OrganPlacing placing_;
};

/// Adds the node "leaves" with all levels of detail, or, where the output asks for it, as places of one mesh.
/// `finest`: the finest level, where it was made before.
void add_leaves(Model& model, const Leaves& leaves, TreeLevels& levels,
                std::optional<std::vector<Foliage>> finest, Job& job);

}  // namespace seedmesh::tree
