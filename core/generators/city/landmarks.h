#pragma once
/// Landmarks: models at given positions, on lots, in parks or elsewhere.
#include <optional>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Returns the landmarks of a request. A landmark without a seed gets one from the seed of the request and its index.
std::vector<Landmark> landmarks_of(const CityParams& params, const Job& job);

/// Finds the part and the lot below each landmark. Unless `plot` is free, the house of the lot is removed. The first
/// landmark that fits gets the lot. A landmark that does not fit is marked (`is_too_large`).
void place_landmarks(CityPlan& plan);

/// Returns the box around the ground plan of a landmark that is a building and stands in the area. Returns nullopt
/// for other models.
std::optional<Footing> footing_of(const Landmark& landmark);

/// Returns warnings about landmarks outside the area, on streets, on water, or larger than their lot or square.
std::vector<Warning> landmark_warnings(const CityPlan& plan);

}  // namespace seedmesh::city
