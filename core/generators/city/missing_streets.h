#pragma once
/// Given streets that are not in the plan.
#include <vector>

#include "core/generators/city/given.h"
#include "core/model/model.h"

namespace seedmesh::city {

/// Returns a warning for each of the first 20 features of which a piece is missing in the plan. Pieces are parts on
/// land, and bridges and tunnels with both ends on land. Pieces below 1 m do not count, nor those below 3.1 m beside
/// a piece that was built.
std::vector<Warning> missing_streets(const std::vector<GivenLine>& lines, const CityPlan& plan);

}  // namespace seedmesh::city
