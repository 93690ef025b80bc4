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

/// Returns the largest rectangle inside rings as of a Plan: the inside is to the left. The plane is cut into vertical
/// slabs at corners (of more than 400, at every n-th) and at equal steps between. For each run of adjacent slabs, the
/// y intervals that are inside in every slab are candidates. The search is repeated with finer steps near the sides of
/// the best candidate. The sides are exact if they lie at corners, else within a thousandth. The area is 0 if nothing
/// is inside. Cost: the square of the slabs (at most 600) times the intervals.
InnerRectangle inner_rectangle(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job);

}  // namespace seedmesh::building
