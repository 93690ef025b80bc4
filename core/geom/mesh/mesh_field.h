#pragma once
/// Distance queries on a closed triangle mesh.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/base/array.h"
#include "core/model/model.h"

namespace seedmesh {

/// A bounding volume hierarchy over triangles. Each node is split at the median along the longest side of the
/// box of its triangles' centres. Building takes n log n; a query takes about log n near the surface.
class MeshField {
 public:
  struct Nearest {
    glm::dvec3 point{0};
    double distance = 0;         ///< not negative
    std::uint32_t triangle = 0;  ///< that contains the point; a guess for positions nearby
  };

  /// Takes all triangles of the model, with node transforms and instances applied; then scales them by
  /// `stretch` about the origin and moves them by `shift`.
  MeshField(const Model& model, const glm::dvec3& stretch, const glm::dvec3& shift, const Job& job);

  /// Takes the triangles of meshes as they are.
  MeshField(std::span<const Mesh* const> meshes, const Job& job);

  std::size_t triangles() const { return corner_.size() / 3; }
  /// Returns the nearest point of the surface. There must be at least one triangle. The search is faster where the
  /// triangle `guess` is near; the result does not depend on it.
  Nearest nearest(const glm::dvec3& point, std::uint32_t guess = 0) const;
  /// True where the point is inside, by the parity of the intersections of a ray. The direction of the ray depends on
  /// the extent of the mesh only and is unlikely to be parallel to an edge.
  bool contains(const glm::dvec3& point) const;

 private:
  struct BvhNode {
    glm::vec3 low{0}, high{0};
    /// First triangle of a leaf. Of an inner node, the second child; the first child is the next node.
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< number of triangles; 0: an inner node
  };
  /// Builds the hierarchy over `corner_`, and sorts the triangles.
  void build_all(const Job& job);
  std::uint32_t build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order);
  glm::dvec3 corner(std::uint32_t triangle, int k) const {
    return corner_[3 * std::size_t{triangle} + static_cast<std::size_t>(k)];
  }

  Array<glm::vec3> corner_;  ///< three for each triangle
  std::vector<BvhNode> bvh_nodes_;
};

}  // namespace seedmesh
