#pragma once
/// How far a box lies inside a solid, and whether a straight line meets one: the exact tests behind questions
/// to other shapes, for solids that are no boxes.
#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// A box in space: from `origin` along the columns of the axes by `size`; a size may be 0.
struct Scope {
  glm::dvec3 origin{0}, size{0};
  glm::dmat3 axes{1};
};

/// What share of the box lies inside a closed solid of the unit cube of `other`, 0 to 1. A flat box counts as
/// inside where the solid is on either side of it. Cost: six cuts of the solid.
double share_inside(const Scope& box, const Solid& solid, const Scope& other);

/// Does the line from `from` to `to` meet the solid (null: the whole box `other`), its first and last part of
/// `skin` metres left out?
bool is_met(const glm::dvec3& from, const glm::dvec3& to, const Solid* solid, const Scope& other,
            double skin);

/// The point of the box that is nearest.
glm::dvec3 nearest_point(const Scope& box, const glm::dvec3& to);

}  // namespace seedmesh::building
