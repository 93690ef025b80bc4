#pragma once
/// Merges bodies into one mesh for each layer, with one primitive for each material.
#include <vector>

#include "core/generators/building/body_source.h"

namespace seedmesh::building {

struct MergeInput {
  const Shapes& shapes;
  MaterialTable& materials;
  BodySource& source;
  glm::dvec3 low{0};    ///< minimum corner of the box around all bodies
  double diagonal = 1;  ///< diagonal of the box around all bodies
};

/// Returns the meshes of all layers; empty if nothing is drawn. Walls side by side share their corners, including
/// those in the middle of a neighbour's edge (coplanar_rectangles.h). Spends Resource::triangles. Returns at least
/// `least` layers, or one for each body if there are fewer bodies. Levels of detail need equal numbers of layers.
std::vector<MeshGroup> merged_bodies(const Model& model, const MergeInput& merging,
                                     std::vector<DrawnBody>& bodies, std::size_t least, Job& job);

}  // namespace seedmesh::building
