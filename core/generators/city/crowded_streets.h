#pragma once
/// Given streets that run too near to each other.
#include <vector>

#include "core/generators/city/given.h"
#include "core/model/model.h"

namespace seedmesh::city {

/// Returns a warning for each of the first 20 features with a street of level 0 whose carriageway overlaps that of
/// an earlier given street without a common node. Arms of one junction do not count as far as arms at 22.5 degrees
/// would be as near to each other. Cost: n log n, and for each warning linear in the lines.
std::vector<Warning> crowded_streets(const std::vector<GivenLine>& lines, const CityPlan& plan,
                                     const Job& job);

}  // namespace seedmesh::city
