#pragma once
/// Warnings about parameters that a request gives and that have no effect.
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/schema/unused.h"

namespace seedmesh {

/// `unused`: from unused_parameters(params), which is generated from the schema.
inline std::vector<Warning> warnings_of(std::vector<UnusedParameter> unused) {
  std::vector<Warning> warnings;
  warnings.reserve(unused.size());
  for (UnusedParameter& each : unused)
    warnings.push_back({std::move(each.pointer), std::move(each.message), 0, 0});
  return warnings;
}

}  // namespace seedmesh
