#pragma once
/// The largest rectangle inside a polygon with holes, its sides along x and y.
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/job.h"

namespace seedmesh::building {

struct InnerRectangle {
  glm::dvec2 low{0}, high{0};
  double area() const { return (high.x - low.x) * (high.y - low.y); }
};

/// Rings as of a Plan: inside is to the left. The plane is cut into upright slabs at all corners and at even
/// steps between; of every row of slabs the intervals in y that are inside all along are kept, and the widest
/// one counts. The steps are then taken anew around the sides that were found. Exact where sides lie at
/// corners, else within a thousandth. Area 0 where nothing is inside. Cost: the square of the slabs (at most
/// 600) times the intervals.
InnerRectangle inner_rectangle(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job);

}  // namespace seedmesh::building
