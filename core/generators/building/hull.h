#pragma once
/// Convex hulls of few points.
#include <glm/glm.hpp>
#include <span>

#include "core/generators/building/solid.h"

namespace seedmesh::building {

constexpr std::size_t most_hull_points = 32;

/// Returns the convex hull as a closed solid of flat faces, in the coordinates of the points. It has no faces
/// if the points lie in a plane. Of more than most_hull_points points, only those farthest in 32 directions
/// are used. A face is a plane through three points that has all others behind it. Cost: n^4 for n points,
/// about 0.2 ms for 16.
Solid hull_of(std::span<const glm::dvec3> points);

}  // namespace seedmesh::building
