#pragma once
/// Converts flat faces of a Solid to Plan (a polygon with holes in the plane) and back.
#include <vector>

#include "core/generators/building/shapes.h"
#include "core/geom/polygon/plan.h"

namespace seedmesh::building {

/// The plane of a flat scope. x of a plan lies along axis u, y along axis v, and w is the normal; the three
/// are right-handed in this order.
struct FacePlane {
  int u, v, w;
  explicit FacePlane(const glm::dvec3& size)
      : u((flat_axis(size) + 1) % 3), v((flat_axis(size) + 2) % 3), w(flat_axis(size)) {}
  glm::dvec2 flat(const glm::dvec3& p) const { return {p[u], p[v]}; }
  glm::dvec3 raised(const glm::dvec2& p, double height) const {
    glm::dvec3 out(0);
    out[u] = p.x;
    out[v] = p.y;
    out[w] = height;
    return out;
  }
};

/// Returns a plan for each face of a flat solid, in metres. `size` is the size of the scope.
std::vector<Plan> plans_of(const Solid& solid, const glm::dvec3& size, const FacePlane& plane);

/// Removes points next to another one, which cuts through a corner leave, and rings that then have fewer than three. The
/// limit is twice that of defects_of(). Without an outer ring, the plan has no rings.
void remove_repeated_points(Plan& plan);

/// Adds a plan as a face. Its points are in metres. Later, fit() (solid.h) converts them to fractions of the scope.
void add_plan(Solid& solid, const Plan& plan, const FacePlane& plane, std::uint8_t tag);

}  // namespace seedmesh::building
