#pragma once
/// Pictures of a shape grammar: lines, labelled points and solids, of two or three dimensions.
///
/// Lines are kept maximal: none lies in another, and none goes on where another ends in the same direction.
/// Then a shape is a part of another exactly if each of its lines lies in one line of the other (Stiny,
/// "Introduction to shape and shape grammars", 1980; Krishnamurti, "The arithmetic of shapes", 1980). Markers
/// and solids are wholes, as in a set grammar (Stiny, "Spatial relations and grammars", 1982).
///
/// Metres, +y up. Pictures of two dimensions lie in y = 0, their own y along -z, so that from above they are
/// seen as they are written.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace seedmesh::building {

struct PictureLine {
  glm::dvec3 from{0}, to{0};
};

/// A labelled point, or two or three in a row that tell direction and size too.
struct PictureMarker {
  std::uint32_t label = 0;  ///< into PictureGrammar::labels
  std::uint32_t count = 1;
  std::array<glm::dvec3, 3> points{};
};

enum class SolidKind : std::uint8_t { box, cylinder, cone, sphere, pyramid, prism, triangular_prism };

struct PictureSolid {
  SolidKind kind = SolidKind::box;
  std::uint32_t material = 0;  ///< into PictureGrammar::materials
  glm::dvec3 base{0};          ///< the middle of its base
  glm::dmat3 axes{1};          ///< at right angles; a mirrored one has a negative determinant
  glm::dvec3 size{1};          ///< y is 0 in pictures of two dimensions
};

/// A point by which solids are told apart and found: equal solids have equal points of equal roles, whichever
/// way their own axes run.
struct KeyPoint {
  glm::dvec3 at{0};
  std::uint32_t role = 0;
};

struct ShapePicture {
  std::vector<PictureLine> lines;
  std::vector<PictureMarker> markers;
  std::vector<PictureSolid> solids;
};

/// p -> turn * (scale * p) + shift, where `turn` is at right angles and may mirror.
struct Similarity {
  glm::dmat3 turn{1};
  double scale = 1;
  glm::dvec3 shift{0};
  glm::dvec3 of(const glm::dvec3& p) const { return turn * (scale * p) + shift; }
  PictureLine of(const PictureLine& line) const { return {of(line.from), of(line.to)}; }
  PictureMarker of(const PictureMarker& marker) const;
  PictureSolid of(const PictureSolid& solid) const;
};

/// At most eight; `radius` is 0 where the solid is not round.
std::vector<KeyPoint> key_points(const PictureSolid& solid, double& radius);

/// Do they agree to `near` metres?
bool are_equal(const PictureMarker& a, const PictureMarker& b, double near);
bool are_equal(const PictureSolid& a, const PictureSolid& b, double near);

/// Lies the line in one of these? Cost: linear.
bool contains(const std::vector<PictureLine>& lines, const PictureLine& line, double near);

/// The sum and the difference with one line; both stay maximal. Cost: linear.
void add_line(std::vector<PictureLine>& lines, PictureLine line, double near);
void remove_line(std::vector<PictureLine>& lines, const PictureLine& line, double near);

/// Adds what is not there yet.
void add(ShapePicture& to, const ShapePicture& what, double near);

/// The greatest coordinate, without sign.
double reach_of(const ShapePicture& picture);

}  // namespace seedmesh::building
