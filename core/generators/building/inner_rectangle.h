#pragma once
/// Finds the largest rectangle inside a polygon with holes, with sides along x and y.
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/job.h"

namespace seedmesh::building {

struct InnerRectangle {
  glm::dvec2 low{0}, high{0};
  double area() const { return (high.x - low.x) * (high.y - low.y); }
};

/// Returns the largest rectangle inside `rings`, whose inside is to the left as in a Plan. The plane is cut into
/// vertical slabs at equal steps and at the corners of the rings. With 400 corners or more, it is cut at every n-th
/// corner. For each run of adjacent slabs, the y intervals that are inside in every slab are candidates. The search
/// is repeated with finer steps near the sides of the best candidate. The sides are exact if they lie at corners.
/// Otherwise the finest steps are below a thousandth of the width of the rings. The area is 0 if nothing is inside.
/// Cost: the square of the number of slabs (at most 600) times the number of intervals.
InnerRectangle inner_rectangle(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job);

}  // namespace seedmesh::building
