#pragma once
/// Do points keep a distance from each other?
#include <span>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// True only where no two points that are not twins are within `reach` of each other; `twin` is 1 for points
/// that stand where one before them does. False where some are, or where finding out would take longer than
/// is_crowded() does. 10 ns a point.
bool stand_apart(std::span<const glm::vec3> points, std::span<const std::uint8_t> twin, float reach,
                 const Job& job);

}  // namespace seedmesh
