#pragma once
/// Decks, parapets and piers of bridges, and the tubes of tunnels.
#include <optional>

#include "core/base/job.h"
#include "core/generators/city/surface.h"
#include "core/model/mesh.h"

namespace seedmesh::city {

/// Returns all bridges as one mesh.
Mesh bridge_mesh(const CityPlan& plan, const Job& job);

/// Returns the inner surfaces of all tunnels as one mesh. At the mouths, they meet the openings of the walls.
Mesh tunnel_mesh(const Surface& surface, const Job& job);

/// Returns a warning about tunnels that are left out.
std::optional<Warning> tunnel_warning(const Surface& surface);

}  // namespace seedmesh::city
