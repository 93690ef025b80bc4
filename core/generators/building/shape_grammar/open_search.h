#pragma once
/// Searches points of a figure that can be those of a left shape with open variables.
#include <functional>

#include "core/generators/building/shape_grammar/open_pairs.h"

namespace seedmesh::building {

/// Which crossings lie on which lines of a figure.
struct LinePoints {
  std::vector<std::vector<std::uint32_t>> lines_of_point, points_of_line;
  double per_line = 0;  ///< the mean number of points on a line
};

/// Cost: the product of lines and points.
LinePoints line_points(const std::vector<FigureLine>& lines, const std::vector<FigureAnchor>& crossings,
                       double near, const Job& job);

/// The points of a figure by kind, as the search sees them.
struct FigurePoints {
  const std::map<std::uint32_t, std::vector<FigureAnchor>>& by_kind;
  const LinePoints& on_lines;  ///< lines of the points of the kind anchor_crossing
  const std::vector<FigureLine>& lines;
  double near = 0;  ///< metres that matched points may differ, with a margin
};

/// Calls `found` with a point of the figure for each anchor in this order. Kinds agree, points of one marker or
/// solid belong to one, and crossings that a line of the left shape joins lie on one line. If these points determine
/// the position of another anchor, as they determine a centroid, the figure has a point there, or lines to it. Calls
/// `look` for each point that it tries.
void search_points(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
                   const FigurePoints& points, const std::function<void()>& look,
                   const std::function<void(const std::vector<glm::dvec3>&)>& found);

}  // namespace seedmesh::building
