#pragma once
/// Pictures of a shape grammar, which requests and documentation call figures: lines, labelled points and solids in two
/// or three dimensions.
///
/// Lines are maximal: no line lies in another, and no line continues another in the same direction. So a
/// shape is part of another exactly if each of its lines lies in one line of the other (Stiny, "Introduction
/// to shape and shape grammars", 1980; Krishnamurti, "The arithmetic of shapes", 1980). Markers and solids
/// are wholes, as in a set grammar (Stiny, "Spatial relations and grammars", 1982).
///
/// Metres, +y up. Pictures of two dimensions lie in the plane y = 0. Their y axis is -z, so that they appear
/// as written when seen from above.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace seedmesh::building {

struct PictureLine {
  glm::dvec3 from{0}, to{0};
};

/// A labelled point, or two or three points that also determine a direction and a size.
struct PictureMarker {
  std::uint32_t label = 0;  ///< index into PictureGrammar::labels
  std::uint32_t count = 1;
  std::array<glm::dvec3, 3> points{};
};

enum class SolidKind : std::uint8_t { box, cylinder, cone, sphere, pyramid, prism, triangular_prism };

struct PictureSolid {
  SolidKind kind = SolidKind::box;
  std::uint32_t material = 0;  ///< index into PictureGrammar::materials
  glm::dvec3 base{0};          ///< the middle of its base
  glm::dmat3 axes{1};          ///< orthonormal; the determinant of a mirrored solid is negative
  glm::dvec3 size{1};          ///< y is 0 in pictures of two dimensions
};

/// A point by which solids are compared. Equal solids have equal points of equal roles, whatever the
/// directions of their axes.
struct KeyPoint {
  glm::dvec3 at{0};
  std::uint32_t role = 0;
};

struct ShapePicture {
  std::vector<PictureLine> lines;
  std::vector<PictureMarker> markers;
  std::vector<PictureSolid> solids;
};

/// p -> turn * (scale * p) + shift. `turn` is orthonormal and may mirror.
struct Similarity {
  glm::dmat3 turn{1};
  double scale = 1;
  glm::dvec3 shift{0};
  glm::dvec3 of(const glm::dvec3& p) const { return turn * (scale * p) + shift; }
  PictureLine of(const PictureLine& line) const { return {of(line.from), of(line.to)}; }
  PictureMarker of(const PictureMarker& marker) const;
  PictureSolid of(const PictureSolid& solid) const;
};

/// Returns at most eight points. Sets `radius`, which is 0 unless the solid is round.
std::vector<KeyPoint> key_points(const PictureSolid& solid, double& radius);

/// Whether two elements are equal to within `near` metres.
bool are_equal(const PictureMarker& a, const PictureMarker& b, double near);
bool are_equal(const PictureSolid& a, const PictureSolid& b, double near);

/// Whether the line lies in one of `lines`. Cost: linear.
bool contains(const std::vector<PictureLine>& lines, const PictureLine& line, double near);

/// Adds or removes a line; the lines stay maximal. Cost: linear.
void add_line(std::vector<PictureLine>& lines, PictureLine line, double near);
void remove_line(std::vector<PictureLine>& lines, const PictureLine& line, double near);

/// Adds the elements that `to` does not have yet.
void add(ShapePicture& to, const ShapePicture& what, double near);

/// Returns the greatest magnitude of a coordinate.
double reach_of(const ShapePicture& picture);

}  // namespace seedmesh::building
