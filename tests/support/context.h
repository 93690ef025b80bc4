#pragma once
/// The context in which the pipeline calls a generator, for tests that call a generator directly.
#include "core/registry/registry.h"

namespace seedmesh {

inline GenerateContext context_of(Job& job, const Demand& demand = {}) { return {job, demand, generators()}; }

}  // namespace seedmesh
