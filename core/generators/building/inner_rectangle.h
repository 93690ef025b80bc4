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

/// The largest rectangle inside rings as of a Plan: the inside is to the left. The plane is cut into vertical
/// slabs at all corners and at even steps between. For every run of slabs, the intervals in y that are inside
/// all along give rectangles. Finer steps around the best sides follow. The sides are exact if they lie at
/// corners, else within a thousandth. The area is 0 if nothing is inside. Cost: the square of the slabs (at
/// most 600) times the intervals.
InnerRectangle inner_rectangle(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job);

}  // namespace seedmesh::building
