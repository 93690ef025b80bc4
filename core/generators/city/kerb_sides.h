#pragma once
/// The sides of streets while the street space is laid out.
#include <vector>

#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// The kerb along the left side of a half-edge. Lists of kerb sides are indexed by half-edge.
struct KerbSide {
  std::vector<CmPoint> corner;                        ///< kerb around the corner at its start
  std::vector<CmPoint> outer_corner;                  ///< border of the block around that corner
  CmPoint to{};                                       ///< point where the kerb ends
  CmPoint cut_from{}, cut_to{};                       ///< points where the carriageway begins and ends
  std::uint32_t before = no_index, after = no_index;  ///< half-edges of the same outline
  bool is_laid_out = false;                           ///< its face is part of the area
  const CmPoint& from() const { return corner.back(); }
};

/// Appends a point unless it is the last one already.
inline void append_new(CmRing& ring, const CmPoint& p) {
  if (ring.empty() || ring.back() != p) ring.push_back(p);
}
/// Removes points at the end of a ring that equal its first one.
inline void close(CmRing& ring) {
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
}

/// Returns the unit direction of a half-edge.
glm::dvec2 unit_of(const StreetGraph& graph, std::uint32_t half);

/// Returns, by half-edge, how far the corners at its start reach along it, on both sides, in metres.
std::vector<double> corner_reaches(const StreetGraph& graph, const std::vector<KerbSide>& sides);

/// Returns the outline of a junction: the ends of its carriageways, and the kerbs around the corners between them.
/// Empty at a node without sides that are laid out.
CmRing junction_ring(const StreetGraph& graph, const std::vector<KerbSide>& sides, std::uint32_t node);

/// Returns the outline of a carriageway. If a street runs along the border of the area, only its inner half is
/// outlined.
CmRing carriageway_ring(const StreetGraph& graph, const std::vector<KerbSide>& sides, std::uint32_t edge);

/// Returns the sidewalk to the left of a half-edge: along the kerb, and back along the block. At a corner, the two
/// sidewalks meet at its middle.
CmRing sidewalk_ring(const std::vector<KerbSide>& sides, std::uint32_t half);

/// Makes the ends of carriageways at junctions perpendicular where there is space. Replaces the previous ends.
void cut_carriageways(const StreetGraph& graph, std::vector<KerbSide>& sides);

/// Removes the perpendicular ends at junctions whose outlines would cross themselves because of these ends. Returns the
/// nodes whose outlines still cross themselves.
std::vector<std::uint32_t> undo_unsound_cuts(const StreetGraph& graph, std::vector<KerbSide>& sides);

}  // namespace seedmesh::city
