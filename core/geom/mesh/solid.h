#pragma once
/// Solids that limit growth, with their signed distance and nearest surface point.
#include <memory>

#include "core/geom/mesh/mesh_field.h"

namespace seedmesh {

enum class SolidShape { box, sphere, cylinder, cone, mesh };

/// A shape that fills a box of `size`. `position` is the centre of the box's lower face. Cylinders are
/// upright; cones have their apex up. Sphere, cylinder and cone are scaled where the sides of the box differ.
/// Absolute distances are then upper bounds; they are far too large in long, thin shapes.
struct Solid {
  SolidShape shape = SolidShape::box;
  glm::dvec3 position{0};
  glm::dvec3 size{1};
  std::shared_ptr<const MeshField> mesh;  ///< for SolidShape::mesh, in world space; else null
};

/// The result of a query from a point.
struct SurfacePoint {
  glm::dvec3 nearest{0};
  double distance = 0;  ///< positive outside, negative inside
};

SurfacePoint surface_near(const Solid& solid, const glm::dvec3& point);

}  // namespace seedmesh
