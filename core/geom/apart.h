#pragma once
/// Which points keep no distance from others?
#include <span>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Marks with 1 all points that are within `reach` of another, twins apart, and some that are not; `twin` is
/// 1 for points that stand where one before them does, `box` holds all. Nothing where there are none. 5 ns a
/// point and thread.
Array<std::uint8_t> near_others(std::span<const glm::vec3> points, std::span<const std::uint8_t> twin,
                                const Box& box, float reach, const Job& job);

}  // namespace seedmesh
