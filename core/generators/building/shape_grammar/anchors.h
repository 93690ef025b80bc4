#pragma once
/// Distinguished points: what similarities are found from.
#include <map>

#include "core/base/job.h"
#include "core/generators/building/shape_grammar/picture.h"

namespace seedmesh::building {

/// A point that a similarity keeps what it is: the n-th point of a marker, a corner of a solid, a crossing.
struct PictureAnchor {
  glm::dvec3 at{0};
  std::uint32_t kind = 0;   ///< points of one kind may fall on each other
  std::uint32_t owner = 0;  ///< the marker or solid that has it; lines have none
};
constexpr std::uint32_t no_owner = 0xFFFFFFFFU;
constexpr std::uint32_t anchor_crossing = 0, anchor_end = 1;

/// Of markers and solids alone.
std::vector<PictureAnchor> anchors_of_wholes(const ShapePicture& picture);
/// Where two lines cross or meet, ends included; each place once for each pair. Cost: the square of the
/// lines.
std::vector<PictureAnchor> crossings_of(const std::vector<PictureLine>& lines, double near, const Job* job);
std::vector<PictureAnchor> ends_of(const std::vector<PictureLine>& lines);

/// What the anchors of a left shape are: all, and those of ends only where the others do not tell its place.
/// `is_told`: two points, or in space three that are not in a line.
std::vector<PictureAnchor> anchors_of_left(const ShapePicture& left, bool is_flat, bool& is_told);

/// Three anchors that tell a similarity (two in the plane; the third repeats the second), by the kinds that
/// the picture has fewest of.
std::array<PictureAnchor, 3> chosen_anchors(const std::vector<PictureAnchor>& anchors, bool is_flat,
                                            const std::map<std::uint32_t, std::size_t>& counts);

}  // namespace seedmesh::building
