#pragma once
/// Decks, parapets and piers of bridges.
#include "core/base/job.h"
#include "core/generators/city/plan.h"
#include "core/model/mesh.h"

namespace seedmesh::city {

/// Returns all bridges as one mesh. Tunnels have no surface above the ground and are left out.
Mesh bridge_mesh(const CityPlan& plan, const Job& job);

}  // namespace seedmesh::city
