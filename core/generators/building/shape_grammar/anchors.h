#pragma once
/// Distinguished points, from which similarities between shapes are found (Krishnamurti 1981).
#include <map>

#include "core/base/job.h"
#include "core/generators/building/shape_grammar/figure.h"

namespace seedmesh::building {

/// A point that every similarity maps to a point of the same kind: the n-th point of a marker, a corner of a
/// solid, a crossing of lines.
struct FigureAnchor {
  glm::dvec3 at{0};
  std::uint32_t kind = 0;    ///< a similarity can map it only to points of the same kind
  std::uint32_t owner = 0;   ///< the marker or solid of the point, or no_owner
  std::uint32_t corner = 0;  ///< number of the key point of a solid
};
constexpr std::uint32_t no_owner = 0xFFFFFFFFU;
constexpr std::uint32_t anchor_crossing = 0, anchor_end = 1;

/// Returns the anchors of markers and solids.
std::vector<FigureAnchor> anchors_of_wholes(const Figure& figure);
/// Returns the points where two lines cross or meet, once for each pair. Cost: the square of the lines.
std::vector<FigureAnchor> crossings_of(const std::vector<FigureLine>& lines, double near, const Job* job);
std::vector<FigureAnchor> ends_of(const std::vector<FigureLine>& lines);

/// Returns the anchors of a left shape. Ends of lines count only if the others do not determine a similarity.
/// `is_determined` becomes true if there are two different points, or in space three that are not on a line.
std::vector<FigureAnchor> anchors_of_left(const Figure& left, bool is_flat, bool& is_determined);

/// Returns three anchors that determine a similarity, of the kinds that are rarest in the figure. In the
/// plane two are sufficient, and the third repeats the second.
std::array<FigureAnchor, 3> chosen_anchors(const std::vector<FigureAnchor>& anchors, bool is_flat,
                                           const std::map<std::uint32_t, std::size_t>& counts);

}  // namespace seedmesh::building
