#pragma once
/// Roundabouts in place of junctions of major streets.
#include "core/base/job.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityStreets;
}

namespace seedmesh::city {

/// Returns the pieces of a graph of major streets in which a share of the junctions with space around them has become
/// rings of minor streets, by the keys of their nodes. `ring_nodes` gets the nodes of the rings, sorted.
std::vector<StreetPiece> with_roundabouts(const StreetGraph& majors, const CityStreets& streets,
                                          const Rng& rng, std::vector<CmPoint>& ring_nodes, const Job& job);

}  // namespace seedmesh::city
