#pragma once
/// Voronoi cells by the intersection of half planes.
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// Returns the cells of distinct points within the box [low, high]: counter-clockwise rings in the order of the
/// points. Corners that several cells share agree up to rounding. A point outside of the box can have an empty cell.
/// Cost: quadratic.
std::vector<std::vector<glm::dvec2>> voronoi_cells(std::span<const glm::dvec2> points, const glm::dvec2& low,
                                                   const glm::dvec2& high, const Job& job);

}  // namespace seedmesh
