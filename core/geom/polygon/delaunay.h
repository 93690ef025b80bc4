#pragma once
/// Improvement of the triangles of surfaces over a plane: edge flips towards the Delaunay triangulation, and
/// additional points inside.
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// Improves a triangulation of a polygon. Edges of only one triangle form the outline of the polygon and stay.
/// Lawson, "Software for C1 surface interpolation", 1977: an edge is flipped where the circle about one triangle
/// contains the opposite corner of the other. Triangles of area 0 at straight corners of the outline disappear.
///
/// `triangles` has three numbers of `points` each, counter-clockwise. The points of `inner` that lie inside are
/// appended to `points` and become corners. `job` may be null. Cost: about n square root of n for n inner points.
void refine_triangles(std::vector<glm::dvec2>& points, std::vector<std::uint32_t>& triangles,
                      std::span<const glm::dvec2> inner, const Job* job);

}  // namespace seedmesh
