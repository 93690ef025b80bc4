#pragma once
/// Statistics of a street network, by the definitions of OSMnx (Boeing, "OSMnx: new methods for acquiring,
/// constructing, analyzing, and visualizing complex street networks", 2017; "Urban spatial order: street network
/// orientation, configuration, and entropy", 2019).
#include "core/base/job.h"
#include "core/generators/city/plan.h"
#include "core/schema/json.h"

namespace seedmesh::city {

/// Distance from the border of the area, in metres, within which streets are left out.
constexpr double border_margin = 60;

/// Returns the statistics that docs/cities.md lists. A value whose divisor is 0 is null.
Json statistics_of(const CityPlan& plan, const Job& job);

/// Returns the area of the points that are at least `margin` from the border, in square metres. The error is below
/// 0.01 % of the area.
double inner_area(const std::vector<CmRing>& area, double margin, const Job& job);

}  // namespace seedmesh::city
