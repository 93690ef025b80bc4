#pragma once
/// Shapes -> Model: the active shapes as meshes.
#include <span>

#include "core/generators/building/looks.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"

namespace seedmesh::building {

/// An asset that shapes insert, in its own box.
struct Asset {
  glm::dvec3 low{0}, size{1};
  std::vector<Primitive> primitives;  ///< materials are those of the model
  const PartRow* row =
      nullptr;  ///< a built-in part: made for each size that is asked for, without primitives
};

/// What one body adds to a file.
struct BodyCost {
  std::uint64_t triangles = 0, vertices = 0, primitives = 1;

  /// Positions and normals of 12 bytes, indices of 16 bits.
  std::uint64_t bytes() const { return 24 * vertices + 6 * triangles; }

  /// Whether so many equal bodies had better share a mesh: each draw must save 8 kB of what merging would
  /// write, and all of them 64 kB.
  bool pays(std::uint64_t count) const {
    const std::uint64_t saved = count > 0 ? bytes() * (count - 1) : 0;
    return saved >= 65'536 && saved >= 8'192 * count * primitives;
  }
};

enum class Sharing {
  paying,  ///< equal bodies share a mesh where that pays (BodyCost), others as merged
  nodes,   ///< equal bodies share a mesh, and each has a node
  merged,  ///< one mesh a layer, one primitive a material
};

/// Adds a node "building" with all active shapes below it. Shapes without an area are passed over. Merged
/// shapes that touch go to different layers, so that in every mesh an edge lies in at most two triangles.
/// Spends Resource::triangles. Cost: about 0.4 microseconds a box.
void add_bodies(Model& model, const Shapes& shapes, Looks& looks, std::span<Asset> assets, Sharing sharing,
                Job& job);

/// All active shapes merged, for a level of detail: a mesh a layer, by their places in the model. Where
/// `sharing` is not merged there is a node "building" too, with models of the request's own below it.
/// `least`: so many layers, where there are as many bodies.
std::vector<int> add_level(Model& model, const Shapes& shapes, Looks& looks, std::span<Asset> assets,
                           Sharing sharing, std::size_t least, Job& job);

}  // namespace seedmesh::building
