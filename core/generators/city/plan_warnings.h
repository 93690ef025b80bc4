#pragma once
/// Warnings about a city.
#include <vector>

#include "core/base/result.h"
#include "core/generators/city/plan.h"
#include "core/model/model.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Returns warnings: parameters without an effect; given streets that were left out, or that run too near to each other; a terrain that is smaller than
/// the area; landmarks that do not fit; tunnels below level ground.
std::vector<Warning> plan_warnings(const CityParams& params, const CityPlan& plan, const Job& job);

/// Adds warnings about surfaces that the model does not have. Call it before materials get unique names.
void warn_of_unused_surfaces(const CityParams& params, Model& model);

}  // namespace seedmesh::city
