#pragma once
/// Numbers of positions.
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/base/array.h"

namespace seedmesh {

/// `number` has one entry for each position; equal positions have one number, in the order of their first entries, which
/// `first` lists by number.
struct PositionNumbers {
  Array<std::uint32_t> number, first;
};

/// Returns the numbers of positions. Each -0 must have been replaced by 0. Linear time, by hashing.
PositionNumbers position_numbers(const Array<glm::vec3>& positions, const Job& job);

}  // namespace seedmesh
