#pragma once
/// What can be told of a request without making its model.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

struct Estimate {
  std::uint64_t triangles = 0;  ///< or lines or points, where the model has no triangles
  std::uint64_t bytes = 0;      ///< of the GLB
  bool exact = false;
};

struct Appraisal {
  std::vector<Warning> warnings;
  std::optional<Estimate> estimate;
};

}  // namespace seedmesh
