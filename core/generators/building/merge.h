#pragma once
/// Bodies merged: a mesh a layer, a primitive a material.
#include <vector>

#include "core/generators/building/body_source.h"

namespace seedmesh::building {

struct Merging {
  const Shapes& shapes;
  Looks& looks;
  BodySource& source;
  glm::dvec3 low{0};    ///< of the extent of all
  double diagonal = 1;  ///< the same
};

/// A group a layer; none where nothing is drawn. Walls side by side have their corners in common, those in
/// the middle of a neighbour's edge too (seams.h). Spends Resource::triangles. `least`: so many layers, where
/// there are as many bodies.
std::vector<MeshGroup> merged_bodies(const Model& model, const Merging& merging,
                                     std::vector<DrawnBody>& bodies, std::size_t least, Job& job);

}  // namespace seedmesh::building
