#pragma once
/// Decks, parapets and piers of bridges.
#include "core/base/job.h"
#include "core/generators/city/plan.h"
#include "core/model/mesh.h"

namespace seedmesh::city {

/// The height of the middle of a street on another level above the street network, at `along` metres of `length`:
/// level over water, otherwise ramps of 6 % to 5.5 m for each level.
double bridge_height(const CityPlan& plan, const Bridge& bridge, double along, double length);

/// All bridges as one mesh. Tunnels have no surface above the ground and are left out.
Mesh bridge_mesh(const CityPlan& plan, const Job& job);

}  // namespace seedmesh::city
