#pragma once
/// Geometry that is no box: polygons with holes, and solids of them, in the unit cube of their scope, so that
/// moving, turning and scaling a shape leaves them as they are and equal ones are shared.
///
/// A flat shape has coordinate 0 on the axis of its normal and faces along that axis. Outer loops run
/// counter-clockwise seen from outside, holes clockwise.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seedmesh::building {

struct Loop {
  std::uint32_t first = 0, count = 0;  ///< into Solid::corners
};

struct Face {
  std::uint32_t first_loop = 0, loop_count = 0;  ///< the outer loop first
  bool is_round = false;                         ///< part of a curved surface: normals are smoothed
  std::uint8_t tag = 0;                          ///< what an offset made it: face_is_inside, face_is_border
};

constexpr std::uint8_t face_is_inside = 1, face_is_border = 2;

struct Solid {
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> corners;
  std::vector<Loop> loops;
  std::vector<Face> faces;
  bool is_closed = false;
};

/// Adds a face of one loop by its points.
void add_face(Solid& solid, std::span<const std::uint32_t> corners, bool is_round = false);

/// The normal of a face times twice its area, in a scope of `size` (Newell).
glm::dvec3 area_vector(const Solid& solid, const Face& face, const glm::dvec3& size);

double area_of(const Solid& solid, const glm::dvec3& size);
double volume_of(const Solid& solid, const glm::dvec3& size);  ///< of a closed one

/// Moves and scales the points so that they fill the unit cube; `low` and `extent` say what part of the old
/// cube that was. An axis without extent becomes 0.
void fit(Solid& solid, glm::dvec3& low, glm::dvec3& extent);

/// What lies below `at` across the axis (`sign` 1) or above it (-1). Cut faces of a closed solid are capped.
/// Faces may be concave and have holes. Cost: n log n of the corners.
Solid clipped(const Solid& solid, int axis, double at, double sign);

/// A flat face (its normal along `axis`) as a solid of height 1 along that axis, or a pyramid over its
/// middle.
Solid extruded(const Solid& face, int axis);
Solid tapered(const Solid& face, int axis);

/// The unit square with its normal along `axis`.
Solid square(int axis);
Solid unit_box();
Solid cylinder();
Solid pyramid();
Solid prism();             ///< a frustum: its top has half the size
Solid triangular_prism();  ///< a gable: the ridge runs along z
Solid sphere();
Solid cone();

/// The same solid seen in a mirror across the axes whose bit is set.
Solid mirrored(const Solid& solid, unsigned axes);

/// Triangles of a face, three corners of Solid::corners each (as places in `points`). `size` is that of the
/// scope. Holes are joined to the outer loop by the shortest bridge that crosses nothing.
void triangulate(const Solid& solid, const Face& face, const glm::dvec3& size,
                 std::vector<std::uint32_t>& out);

}  // namespace seedmesh::building
