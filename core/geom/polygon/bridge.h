#pragma once
/// One closed outline of a polygon with holes.
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// Joins the holes of a polygon to its outer ring. `points` contains all rings one after the other, with
/// `ring_sizes` points each: the outer ring counter-clockwise, then the holes clockwise. Returns an outline as
/// indices into `points`, in which each bridge between two rings occurs once in each direction. If no two edges
/// of the polygon meet except at common ends, no bridge crosses or touches an edge or another bridge: all tests
/// of sides are exact. Rings of fewer than three points are left out. Cost: points times rings, and the square of
/// the points times rings for hostile ones. Checks stop and deadline where there is a job. Source: Eberly,
/// "Triangulation by ear clipping", 2008.
std::vector<std::uint32_t> join_holes(std::span<const glm::dvec2> points,
                                      std::span<const std::uint32_t> ring_sizes, const Job* job = nullptr);

}  // namespace seedmesh
