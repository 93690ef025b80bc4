#pragma once
/// The surface of one body as vertices and triangles.
#include <glm/glm.hpp>
#include <vector>

#include "core/generators/building/solid.h"
#include "core/geom/polygon/triangulate.h"

namespace seedmesh::building {

/// The vertices and triangles of one body in its own frame.
struct BodySurface {
  std::vector<glm::dvec3> position, normal;
  std::vector<std::uint32_t> index;
  bool has_face_normals = false;  ///< the normals are known to be at right angles to the triangles
  void clear() {
    position.clear();
    normal.clear();
    index.clear();
    has_face_normals = false;
  }
};

/// Makes surfaces, and keeps its working memory from one body to the next.
class SurfaceBuilder {
 public:
  /// `job`, which outlives the object, is checked for stop and deadline.
  explicit SurfaceBuilder(const Job* job = nullptr) : triangulator_(job) {}

  /// Appends a box from the origin to `size`. If one size is 0, appends a rectangle whose normal points along that
  /// axis.
  static void box(const glm::dvec3& size, BodySurface& surface);
  /// Appends a solid scaled by `size`. Flat faces have one normal, round faces smooth normals. Faces without
  /// an area are left out.
  void solid(const Solid& solid, const glm::dvec3& size, BodySurface& surface);

 private:
  void triangulate(const Solid& solid, const Face& face, const glm::dvec3& normal, const glm::dvec3& size);

  Triangulator triangulator_;
  std::vector<glm::dvec3> smooth_;
  std::vector<glm::dvec2> flat_;
  std::vector<std::uint32_t> face_points_, ring_sizes_, triangles_, place_;
};

}  // namespace seedmesh::building
