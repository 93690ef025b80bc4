#pragma once
/// Lines of streets, cut at the border of the area and carried over water.

#include "core/generators/city/plan.h"
#include "core/generators/city/region.h"

namespace seedmesh::city {

/// Where a segment leaves or enters the land.
struct OutlineHit {
  double share = 0;  ///< share of the segment
  double sine = 0;   ///< sine of the angle between segment and outline; 0 near a corner
  bool is_shore = false;
};

/// Returns all positions where the segment from a to b crosses the outline of the land, in order from a, but not a
/// itself.
std::vector<OutlineHit> hits_of(const Region& region, const glm::dvec2& a, const glm::dvec2& b);

/// The part of a line that can be built.
struct Route {
  std::vector<StreetPiece> pieces;
  std::vector<SeparatedLine> separated;
  bool reaches_end = false;
};

/// Follows a line from its start, which is on land. It ends at the border of the area, and crosses water on bridges
/// of at most `bridge_length` centimetres. Returns an empty route if the line would end at a shore. This is also so
/// for a line that would meet the border or a shore at an acute angle, or with a piece below 15 m.
Route route_of(const Region& region, const std::vector<CmPoint>& line, std::uint32_t kind,
               double bridge_length);

/// Like route_of(), for a given line, which may begin anywhere and have any angles and bridges. Parts outside of
/// the area are left out, and parts over water become bridges where both ends are on land.
Route given_route(const Region& region, const std::vector<CmPoint>& line, std::uint32_t kind);

/// Whether a bridge or tunnel of a route meets one of `separated` on the same level.
bool meets_separated(const Route& route, const std::vector<SeparatedLine>& separated);

}  // namespace seedmesh::city
