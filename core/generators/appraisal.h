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
  /// Of what is made of repeated parts: how many are drawn, and the bytes where each is a mesh of its own.
  std::uint64_t copies = 0, merged_bytes = 0;
};

struct Appraisal {
  std::vector<Warning> warnings;
  std::optional<Estimate> estimate;
};

}  // namespace seedmesh
