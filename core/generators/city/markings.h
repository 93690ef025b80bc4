#pragma once
/// Carriageways in strips across the street, so that lane lines, stop lines and zebra crossings are pieces of its
/// surface.
#include <vector>

#include "core/generators/city/plan.h"

namespace seedmesh::city {

enum class StripKind : std::uint8_t {
  lanes,          ///< a carriageway with lines between the lanes
  plain,          ///< a carriageway without lines
  zebra,          ///< a pedestrian crossing
  stop_at_start,  ///< a stop line on the left half, for traffic towards the street's first node
  stop_at_end,    ///< the same on the right half, towards the last node
};

/// A line across a carriageway between its kerbs, in metres.
struct CrossLine {
  glm::dvec2 left{0}, right{0};
};

/// Returns the position at a share of the way from left to right.
inline glm::dvec2 point_across(const CrossLine& line, double share) {
  return share == 0 ? line.left : share == 1 ? line.right : line.left + (line.right - line.left) * share;
}

/// A carriageway from its start to its end. `kinds[i]` lies between the lines i and i + 1.
struct StreetStrips {
  std::vector<CrossLine> lines;
  std::vector<StripKind> kinds;
};

/// Returns the strips of an edge; empty where its carriageway has no straight kerbs on both sides. On a terrain lines
/// are at most 6 m apart.
StreetStrips strips_of_street(const CityPlan& plan, std::uint32_t edge);

/// A piece of a strip between two shares of the way from the left to the right kerb.
struct StripPiece {
  double from = 0, to = 1;
  bool is_marking = false;
};

/// Returns the number of bars of a pedestrian crossing. Gaps are as wide as bars, and lie at both kerbs.
int bars_of(const CrossSection& section);

/// Replaces `pieces` by those of a strip from left to right. With textures, a pedestrian crossing is one piece.
void set_pieces(StripKind kind, const CrossSection& section, bool has_textures,
                std::vector<StripPiece>& pieces);

}  // namespace seedmesh::city
