#pragma once
/// Helpers for the faces of a solid, which the tools and the operators of solids share.
#include <cmath>
#include <utility>

#include "core/base/math.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// Returns the unit normal of a face; +Y if its area is 0.
inline glm::dvec3 unit_normal(const Solid& solid, const Face& face) {
  return math::unit(area_vector(solid, face, glm::dvec3(1)), glm::dvec3(0, 1, 0));
}

/// Copies a face with other loops, the outer one first. Leaves out loops of fewer than three corners, and the whole
/// face if its outer loop has fewer.
inline void copy_face(Solid& to, const Face& face, const std::vector<std::vector<std::uint32_t>>& loops) {
  if (loops.empty() || loops[0].size() < 3) return;
  Face made = face;
  made.first_loop = static_cast<std::uint32_t>(to.loops.size());
  made.loop_count = 0;
  for (const auto& loop : loops) {
    if (loop.size() < 3) continue;
    add_loop(to, loop);
    ++made.loop_count;
  }
  to.faces.push_back(made);
}

/// Indices of the two coordinate axes to which a plane is projected. Counter-clockwise loops stay counter-clockwise.
struct PlaneAxes {
  int u, v;
  explicit PlaneAxes(const glm::dvec3& n) {
    int drop = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::abs(n[k]) > std::abs(n[drop])) drop = k;
    }
    u = (drop + 1) % 3;
    v = (drop + 2) % 3;
    if (n[drop] < 0) std::swap(u, v);
  }
  glm::dvec2 flat(const glm::dvec3& p) const { return {p[u], p[v]}; }
};

/// A directed edge: its start and end in the order of the face's loop.
using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

}  // namespace seedmesh::building
