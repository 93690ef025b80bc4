#pragma once
/// Warnings about parameters that a request gives and that have no effect.
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/schema/unused.h"

namespace seedmesh {

/// Converts the result of unused_parameters(), which is generated from the schema, to warnings without a text position.
inline std::vector<Warning> warnings_of(std::vector<UnusedParameter> unused) {
  std::vector<Warning> warnings;
  warnings.reserve(unused.size());
  for (UnusedParameter& each : unused)
    warnings.push_back({std::move(each.pointer), std::move(each.message), 0, 0});
  return warnings;
}

}  // namespace seedmesh
