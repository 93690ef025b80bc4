#pragma once
/// Landmarks: models at given positions, on lots, in parks or elsewhere.
#include <optional>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// The landmarks of a request. One without a seed takes it from its number.
std::vector<Landmark> landmarks_of(const CityParams& params, const Job& job);

/// Gives each landmark the lot on which it stands. The first one replaces the house of its lot.
void place_landmarks(CityPlan& plan);

/// The box around the ground plan of a landmark that is a building and stands in the area. Null for other models.
std::optional<Footing> footing_of(const Landmark& landmark);

/// Warnings about landmarks outside of the area, on streets and on water.
std::vector<Warning> landmark_warnings(const CityPlan& plan);

}  // namespace seedmesh::city
