#pragma once
/// Points at nearly the same position.
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// Returns for each point the lowest index in its group. Two points are in one group if a chain of steps of
/// at most `reach` joins them. Cost: n log n unless very many points form a chain of such steps. Checks the
/// deadline.
std::vector<std::uint32_t> near_groups(std::span<const glm::dvec3> points, double reach, const Job& job);

}  // namespace seedmesh
