#pragma once
/// Fixed-radius neighbour search.
#include <span>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Returns one mark for each point: 1 where it has a neighbour within `radius`, else 0. Some points with only
/// farther neighbours may get 1 too. The array is empty where no point has a neighbour. `is_duplicate` has one
/// entry for each point: 1 where an earlier point has the same position; such points do not count as neighbours.
/// `box` contains all points. Runs on job.threads(). Cost: 5 ns a point on one thread, divided by the number of
/// threads.
Array<std::uint8_t> near_others(std::span<const glm::vec3> points, std::span<const std::uint8_t> is_duplicate,
                                const Box& box, float radius, const Job& job);

}  // namespace seedmesh
