#pragma once
/// The ends of minor streets that meet no other street.
#include "core/base/rng.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/network.h"
#include "core/generators/city/tunnel_clearance.h"

namespace seedmesh::city {

/// Lets a share of the loose ends of minor streets stay. The others are joined to the first road in reach, or removed.
/// Choices depend on positions, and are made in the order of the positions.
void settle_dead_ends(Network& network, const GrowthInput& input, const TunnelClearance& tunnels,
                      const Rng& rng);

}  // namespace seedmesh::city
