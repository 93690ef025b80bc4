#pragma once
/// Convex hulls of few points.
#include <glm/glm.hpp>
#include <span>

#include "core/generators/building/solid.h"

namespace seedmesh::building {

constexpr std::size_t most_hull_points = 32;

/// The hull as a closed solid of flat faces, in the coordinates of the points; without faces where they lie
/// in a plane. Of more points those that are farthest in 32 directions are taken. Every plane of three points
/// that has all others behind it is a face: cost n^4 for n points, about 0.2 ms for 16.
Solid hull_of(std::span<const glm::dvec3> points);

}  // namespace seedmesh::building
