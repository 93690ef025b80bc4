#pragma once
/// A closed triangle mesh that can be asked how far points are from it.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/array.h"
#include "core/model/model.h"

namespace seedmesh {

/// A tree of boxes over triangles, split at the middle of the longest side of their centres' box. Building:
/// n log n; a question: about log n where the surface is not far.
class MeshField {
 public:
  struct Nearest {
    glm::dvec3 point{0};
    double distance = 0;  ///< not negative
  };

  /// All triangles of the model as it is drawn, node transforms and instances applied, then moved by `shift`
  /// and stretched by `stretch` about the origin before that.
  MeshField(const Model& model, const glm::dvec3& stretch, const glm::dvec3& shift, const Job& job);

  std::size_t triangles() const { return corner_.size() / 3; }
  /// Needs one triangle at least.
  Nearest nearest(const glm::dvec3& point) const;
  /// Is the point inside? By the parity of the crossings of a ray in a direction that no edge has.
  bool holds(const glm::dvec3& point) const;

 private:
  struct Knot {
    glm::vec3 low{0}, high{0};
    std::uint32_t first = 0;  ///< triangle; of an inner knot: its second child, the first stands behind it
    std::uint32_t count = 0;  ///< of triangles; 0: an inner knot
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order);
  glm::dvec3 corner(std::uint32_t triangle, int k) const {
    return corner_[3 * std::size_t{triangle} + static_cast<std::size_t>(k)];
  }

  Array<glm::vec3> corner_;  ///< three a triangle
  std::vector<Knot> knot_;
};

}  // namespace seedmesh
