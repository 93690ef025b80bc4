#pragma once
/// Which shapes are neighbours: a set grammar joins and divides connected shapes (Stiny, "Spatial relations and
/// grammars", 1982; Wonka et al., "Instant architecture", 2003).
#include <array>
#include <utility>

#include "core/generators/building/box_tree.h"
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// The border of a shape in the world.
struct Outline {
  int dimension = 0;
  WorldBox box;                                             ///< larger by `near` on all sides
  double near = 0;                                          ///< metres that count as contact
  std::vector<std::array<glm::dvec3, 3>> triangles;         ///< triangles of the faces
  std::vector<std::pair<glm::dvec3, glm::dvec3>> segments;  ///< edges of a flat shape, or the line itself
};

/// Returns the outline of a shape. Assets count as their boxes. Points have no outline.
Outline outline_of(const Derivation& d, const ShapeState& state);

/// Whether two shapes share a part of their borders. Two volumes are neighbours if they lie on opposite sides of a
/// shared part of a face. A flat shape is a neighbour of a volume if it lies on one of its faces. Two flat shapes share
/// a part of an edge, and two lines share an end. Cost: proportional to the product of the numbers of triangles.
bool are_neighbours(const Outline& a, const Outline& b);

}  // namespace seedmesh::building
