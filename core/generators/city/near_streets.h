#pragma once
/// Streets whose carriageways overlap although they have no common node.
#include <cstdint>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/growth.h"
#include "core/geom/polygon/planar_graph.h"

namespace seedmesh::city {

/// Two streets nearer to each other than half of both widths. The numbers are indices of edges.
struct NearPair {
  std::uint32_t first = 0, second = 0;
  double distance = 0;  ///< cm
};

/// Returns the pairs of streets without a common node whose carriageways overlap, in the order of the edges. `widths`
/// are those of the carriageways in centimetres, by tag. Cost: n log n.
std::vector<NearPair> near_pairs(const std::vector<CmPoint>& nodes, const std::vector<PlanarEdge>& edges,
                                 const std::vector<double>& widths, const Job& job);

/// A planar graph of streets.
struct StreetNet {
  const std::vector<CmPoint>& nodes;
  const std::vector<PlanarEdge>& edges;
  const PlanarArms& arms;
};

/// Whether a way along streets between the two streets of a pair is so short that they may be as near to each other as
/// they are: that of arms of one junction at 22.5 degrees.
bool are_linked(const StreetNet& net, const NearPair& pair);

/// Moves bends of streets onto a corner of another street that is nearer than a quarter of both widths, so that the
/// streets have a common node. Streets that would leave the free ground stay.
void join_near_bends(const GrowthInput& input, std::vector<StreetPiece>& pieces, const Job& job);

/// Returns the widths of the carriageways in centimetres, by tag.
std::vector<double> widths_of(const std::vector<CrossSection>& sections);

}  // namespace seedmesh::city
