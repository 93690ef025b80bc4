#pragma once
/// Searches points of a picture that can be those of a left shape with open variables.
#include <functional>

#include "core/generators/building/shape_grammar/open_pairs.h"

namespace seedmesh::building {

/// Which crossings lie on which lines of a picture.
struct LinePoints {
  std::vector<std::vector<std::uint32_t>> lines_of_point, points_of_line;
  double per_line = 0;  ///< the mean number of points on a line
};

/// Cost: the product of lines and points.
LinePoints line_points(const std::vector<PictureLine>& lines, const std::vector<PictureAnchor>& crossings,
                       double near, const Job& job);

/// The points of a picture by kind, as the search sees them.
struct PicturePoints {
  const std::map<std::uint32_t, std::vector<PictureAnchor>>& by_kind;
  const LinePoints& on_lines;  ///< lines of the points of the kind anchor_crossing
  const std::vector<PictureLine>& lines;
  double near = 0;  ///< metres that matched points may differ, with a margin
};

/// Calls `found` with a point of the picture for each anchor in this order. Kinds agree, points of one marker or
/// solid belong to one, and crossings that a line of the left shape joins lie on one line. If these points determine
/// the position of another anchor, as they determine a centroid, the picture has a point there, or lines to it. Calls
/// `look` for each point that it tries.
void search_points(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
                   const PicturePoints& points, const std::function<void()>& look,
                   const std::function<void(const std::vector<glm::dvec3>&)>& found);

}  // namespace seedmesh::building
