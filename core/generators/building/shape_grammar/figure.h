#pragma once
/// Figures of a shape grammar: lines, labelled points and solids in two or three dimensions.
///
/// Lines are maximal: no line lies in another, and no line continues another in the same direction. So a
/// shape is part of another exactly if each of its lines lies in one line of the other (Stiny, "Introduction
/// to shape and shape grammars", 1980; Krishnamurti, "The arithmetic of shapes", 1980). Markers and solids
/// are wholes, as in a set grammar (Stiny, "Spatial relations and grammars", 1982).
///
/// Metres, +y up. Figures of two dimensions lie in the plane y = 0. Their y axis is -z, so that they appear
/// as written when seen from above.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace seedmesh::building {

struct FigureLine {
  glm::dvec3 from{0}, to{0};
};

/// A labelled point, or two or three points that also determine a direction and a size.
struct FigureMarker {
  std::uint32_t label = 0;  ///< index into FigureGrammar::labels
  std::uint32_t count = 1;
  std::array<glm::dvec3, 3> points{};
};

enum class SolidKind : std::uint8_t { box, cylinder, cone, sphere, pyramid, prism, triangular_prism };

struct FigureSolid {
  SolidKind kind = SolidKind::box;
  std::uint32_t material = 0;  ///< index into FigureGrammar::materials
  glm::dvec3 base{0};          ///< the middle of its base
  glm::dmat3 axes{1};          ///< orthonormal; the determinant of a mirrored solid is negative
  glm::dvec3 size{1};          ///< y is 0 in figures of two dimensions
};

/// A point by which solids are compared. Equal solids have equal points of equal roles, whatever the
/// directions of their axes.
struct KeyPoint {
  glm::dvec3 at{0};
  std::uint32_t role = 0;
};

struct Figure {
  std::vector<FigureLine> lines;
  std::vector<FigureMarker> markers;
  std::vector<FigureSolid> solids;
};

/// p -> turn * (scale * p) + shift. `turn` is orthonormal and may mirror.
struct Similarity {
  glm::dmat3 turn{1};
  double scale = 1;
  glm::dvec3 shift{0};
  glm::dvec3 of(const glm::dvec3& p) const { return turn * (scale * p) + shift; }
  FigureLine of(const FigureLine& line) const { return {of(line.from), of(line.to)}; }
  FigureMarker of(const FigureMarker& marker) const;
  FigureSolid of(const FigureSolid& solid) const;
};

/// Returns at most eight points. Sets `radius`, which is 0 unless the solid is round.
std::vector<KeyPoint> key_points(const FigureSolid& solid, double& radius);

/// Whether two elements are equal to within `near` metres.
bool are_equal(const FigureMarker& a, const FigureMarker& b, double near);
bool are_equal(const FigureSolid& a, const FigureSolid& b, double near);

/// Whether the line lies in one of `lines`. Cost: linear.
bool contains(const std::vector<FigureLine>& lines, const FigureLine& line, double near);

/// Adds or removes a line; the lines stay maximal. Cost: linear.
void add_line(std::vector<FigureLine>& lines, FigureLine line, double near);
void remove_line(std::vector<FigureLine>& lines, const FigureLine& line, double near);

/// Adds the elements that `to` does not have yet.
void add(Figure& to, const Figure& what, double near);

/// Returns the greatest magnitude of a coordinate.
double reach_of(const Figure& figure);

}  // namespace seedmesh::building
