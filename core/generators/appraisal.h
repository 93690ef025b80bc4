#pragma once
/// What can be told of a request without making its model.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

struct Estimate {
  std::uint64_t triangles = 0;  ///< none, where the model is of lines or points
  std::uint64_t bytes = 0;      ///< of the GLB, about
  bool exact = false;           ///< the triangles are just so many
};

struct Appraisal {
  std::vector<Warning> warnings;
  std::optional<Estimate> estimate;
};

}  // namespace seedmesh
