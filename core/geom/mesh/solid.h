#pragma once
/// Solids that limit growth, with their signed distance and nearest surface point.
#include <memory>

#include "core/geom/mesh/mesh_field.h"

namespace seedmesh {

enum class SolidShape { box, sphere, cylinder, cone, mesh };

/// A shape that fills a box of `size`. `position` is the centre of the box's lower face. Cylinders are
/// upright; cones have their apex up. Spheres, cylinders and cones are scaled if the sides of the box differ.
/// Their distances are then upper bounds of the true distances, far too large for long, thin shapes. The sign
/// is exact.
struct Solid {
  SolidShape shape = SolidShape::box;
  glm::dvec3 position{0};
  glm::dvec3 size{1};
  /// Surface of SolidShape::mesh in world space; position and size are then not used. Else null.
  std::shared_ptr<const MeshField> mesh;
};

/// The result of a query from a point.
struct SurfacePoint {
  glm::dvec3 nearest{0};
  double distance = 0;  ///< positive outside, negative inside
};

/// Returns the nearest point of the surface and the signed distance.
SurfacePoint surface_near(const Solid& solid, const glm::dvec3& point);
/// Returns the nearest point of the surface alone, without testing on which side the point is.
glm::dvec3 nearest_on_surface(const Solid& solid, const glm::dvec3& point);

/// True where the signed distance is negative. The distance is computed only for points that are enclosed.
bool lies_inside(const Solid& solid, const glm::dvec3& point);
/// True where the signed distance is positive. The distance is computed only for points that are not enclosed.
bool lies_outside(const Solid& solid, const glm::dvec3& point);

}  // namespace seedmesh
