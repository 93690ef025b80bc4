#pragma once
/// Houses: which rule builds on a lot, and the largest rectangle along its front that keeps the setbacks.
#include <array>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityBuildingRule;
struct CityParams;
}  // namespace seedmesh

namespace seedmesh::city {

class FootprintIndex;

/// Returns the rules of the request, or the built-in ones.
const std::vector<CityBuildingRule>& rules_of(const CityParams& params);

/// Gives each lot a house if one of the rules applies and fits. No house lies on an obstacle or a given footprint.
/// `obstacles` may be null.
void place_houses(CityPlan& plan, const CityParams& params, const FieldMap* obstacles,
                  const FootprintIndex& footprints, Job& job);

/// Returns the least and the greatest number of floors that a blueprint takes; 0, 0 for those without floors.
std::array<int, 2> floors_of(std::string_view blueprint);

}  // namespace seedmesh::city
