#pragma once
/// Geometry other than boxes: polygons with holes, and solids made of them. Coordinates are in the unit cube of the
/// scope. They stay the same if a shape is moved, turned or scaled, and equal solids are shared.
///
/// A flat shape has coordinate 0 on the axis of its normal and faces in the positive direction. Outer loops
/// run counter-clockwise seen from outside, holes clockwise.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seedmesh::building {

struct Loop {
  std::uint32_t first = 0, count = 0;  ///< range in Solid::corners
};

struct Face {
  std::uint32_t first_loop = 0, loop_count = 0;  ///< the outer loop first
  bool is_round = false;                         ///< part of a curved surface with smooth normals
  std::uint8_t tag = 0;    ///< face_is_inside, face_is_border (offset), face_is_covered (roof)
  std::uint32_t tags = 0;  ///< index into Shapes::tag_sets
};

constexpr std::uint8_t face_is_inside = 1, face_is_border = 2;
/// A face of the body of a roof below its cover. Its edges are not edges of the roof.
constexpr std::uint8_t face_is_covered = 3;

struct Solid {
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> corners;
  std::vector<Loop> loops;
  std::vector<Face> faces;
  bool is_closed = false;
};

/// Returns the loops of a face, the outer one first.
inline std::span<const Loop> loops_of(const Solid& solid, const Face& face) {
  return std::span(solid.loops).subspan(face.first_loop, face.loop_count);
}
/// Returns the corners of a loop, as positions in Solid::points.
inline std::span<const std::uint32_t> points_of(const Solid& solid, const Loop& loop) {
  return std::span(solid.corners).subspan(loop.first, loop.count);
}

/// Adds a loop of these corners; the caller adds the face.
void add_loop(Solid& solid, std::span<const std::uint32_t> corners);

/// Adds the points and faces of `from`.
void append(Solid& to, const Solid& from);
/// Adds a face of one loop by its points.
void add_face(Solid& solid, std::span<const std::uint32_t> corners, bool is_round = false);

/// Returns the normal of a face times twice its area, in a scope of `size` (Newell).
glm::dvec3 area_vector(const Solid& solid, const Face& face, const glm::dvec3& size);

/// Returns the area of the surface in a scope of `size`; volume_of() returns the volume.
double area_of(const Solid& solid, const glm::dvec3& size);
double volume_of(const Solid& solid, const glm::dvec3& size);  ///< 0 unless the solid is closed

/// Whether a point lies inside loops, seen along a normal (by the crossings of a ray). The loops may be a
/// face or any set of closed loops of the solid.
bool is_inside(const Solid& solid, std::span<const Loop> loops, const glm::dvec3& normal,
               const glm::dvec3& p);

/// Moves and scales the points so that they fill the unit cube. Sets `low` and `extent` to the corner and the sides
/// of the part of the old cube that they filled. Coordinates along an axis without extent become 0.
void fit(Solid& solid, glm::dvec3& low, glm::dvec3& extent);

/// Returns the part of a solid below `at` on the axis (`sign` 1) or above it (`sign` -1). The cut through a closed
/// solid gets caps. Faces may be concave and have holes. Cost: n log n for n corners.
Solid clipped(const Solid& solid, int axis, double at, double sign);

/// Returns a solid of height 1 over a flat face whose normal is `axis`: a prism, or a pyramid whose tip lies over the
/// centroid.
Solid extruded(const Solid& face, int axis);
Solid tapered(const Solid& face, int axis);

/// Returns the unit square with its normal along `axis`.
Solid square(int axis);
Solid unit_box();
Solid cylinder();
Solid pyramid();
Solid frustum();           ///< a frustum: its top has half the size
Solid triangular_prism();  ///< a gable: the ridge runs along z
Solid sphere();
Solid cone();

/// Returns the solid mirrored along each axis whose bit is set.
Solid mirrored(const Solid& solid, unsigned axes);

}  // namespace seedmesh::building
