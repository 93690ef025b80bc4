#pragma once
/// Tests of boxes and lines against solids, for the queries of rules to other shapes.
#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// A box in space: from `origin` along the columns of the axes by `size`; a size may be 0.
struct Scope {
  glm::dvec3 origin{0}, size{0};
  glm::dmat3 axes{1};
};

/// Returns the share of the volume of `box` that lies inside a closed solid in the unit cube of `other`, 0 to 1. Of a
/// flat box, a thin layer on either side is tested and the larger share counts. Cost: six cuts of the solid.
double share_inside(const Scope& box, const Solid& solid, const Scope& other);

/// Whether the line from `from` to `to` meets the solid, or the whole box `other` if `solid` is null. The
/// first and the last `skin` metres do not count.
bool is_line_blocked(const glm::dvec3& from, const glm::dvec3& to, const Solid* solid, const Scope& other,
                     double skin);

/// Returns the point of the box nearest to `to`.
glm::dvec3 nearest_point(const Scope& box, const glm::dvec3& to);

}  // namespace seedmesh::building
