#pragma once
/// The active shapes of a derivation as meshes of a model.
#include <span>

#include "core/generators/building/materials.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"

namespace seedmesh::building {

/// An asset that shapes insert, with the box around it.
struct Asset {
  glm::dvec3 low{0}, size{1};
  std::vector<Primitive> primitives;  ///< materials are those of the model
  /// The row of a built-in part, which has no primitives and is made for each size.
  const PartRow* row = nullptr;
};

/// The amount that one body adds to a file.
struct BodyCost {
  std::uint64_t triangles = 0, vertices = 0, primitives = 1;

  /// Positions and normals of 12 bytes, indices of 16 bits.
  std::uint64_t bytes() const { return 24 * vertices + 6 * triangles; }

  /// Whether `count` equal bodies should share a mesh: compared with merging, they must save
  /// 8 kB for each node and 64 kB in all.
  bool saves_if_shared(std::uint64_t count) const {
    const std::uint64_t saved = count > 0 ? bytes() * (count - 1) : 0;
    return saved >= 65'536 && saved >= 8'192 * count * primitives;
  }
};

enum class Sharing {
  if_smaller,  ///< equal bodies share a mesh if BodyCost::saves_if_shared() is true; others are merged
  nodes,       ///< equal bodies share a mesh, and each has a node
  merged,      ///< one mesh for each layer, with one primitive for each material
};

/// Adds a node "building" with the meshes of all active shapes below it. Shapes without an area are left out.
/// Merged shapes that touch go to different layers, so that an edge of a mesh lies in at most two triangles.
/// Spends Resource::triangles. Cost: about 0.4 us a box.
void add_bodies(Model& model, const Shapes& shapes, MaterialTable& materials, std::span<Asset> assets,
                Sharing sharing, Job& job);

/// How add_level() divides a level of detail.
struct LevelLayers {
  Sharing sharing = Sharing::merged;
  std::size_t least = 0;  ///< number of layers
};

/// Adds all active shapes merged, for a level of detail, and returns the meshes: one for each layer. Unless
/// `layers.sharing` is `merged`, a node "building" is added too, with the assets of the request below it. Returns at
/// least `layers.least` layers, or one for each body if there are fewer bodies. Levels of detail need equal numbers
/// of layers.
std::vector<int> add_level(Model& model, const Shapes& shapes, MaterialTable& materials,
                           std::span<Asset> assets, const LevelLayers& layers, Job& job);

}  // namespace seedmesh::building
