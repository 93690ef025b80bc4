#pragma once
/// The surface of one body as corners and triangles.
#include <glm/glm.hpp>
#include <vector>

#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// The corners and triangles of one body in its own frame: what a mesh is filled with.
struct Patch {
  std::vector<glm::dvec3> position, normal;
  std::vector<std::uint32_t> index;
  void clear() {
    position.clear();
    normal.clear();
    index.clear();
  }
};

/// Keeps its working memory from one body to the next.
class PatchMaker {
 public:
  /// A box from the origin to `size`; where one size is 0 the rectangle that looks along that axis.
  static void box(const glm::dvec3& size, Patch& patch);
  /// Flat faces have one normal, round ones smooth normals. Faces without an area are left out.
  void solid(const Solid& solid, const glm::dvec3& size, Patch& patch);

 private:
  std::vector<glm::dvec3> smooth_;
  std::vector<std::uint32_t> triangles_, place_;
};

}  // namespace seedmesh::building
