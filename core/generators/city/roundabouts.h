#pragma once
/// Roundabouts in place of junctions of major streets.
#include "core/base/job.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityStreets;
}

namespace seedmesh::city {

/// Replaces a share of the junctions by rings of minor streets, where there is enough space, and returns the pieces
/// of the graph. The keys of the nodes decide which junctions are replaced. `ring_nodes` gets the nodes of the rings,
/// sorted.
std::vector<StreetPiece> with_roundabouts(const StreetGraph& majors, const CityStreets& streets,
                                          const Rng& rng, std::vector<CmPoint>& ring_nodes, const Job& job);

}  // namespace seedmesh::city
