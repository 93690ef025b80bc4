#pragma once
/// Points at nearly the same position.
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// For each point the least number of the points that it is joined to, directly or through others, by steps of
/// at most `reach`. Cost: n log n unless very many points form a chain of such steps. Checks the deadline.
std::vector<std::uint32_t> near_groups(std::span<const glm::dvec3> points, double reach, const Job& job);

}  // namespace seedmesh
