#pragma once
/// Solids that growth keeps inside of, or outside of: how far a point is from their surface, and where the
/// nearest point of that is.
#include <memory>

#include "core/geom/mesh_field.h"

namespace seedmesh {

enum class SolidShape { box, sphere, cylinder, cone, mesh };

/// Fills the box of `size` that stands on `position`: the middle of its lower face. A cylinder stands
/// upright, a cone has its point up. Sphere, cylinder and cone whose size differs by axis are stretched;
/// distances to them are then those to a point of the surface near the nearest, so never too small.
struct Solid {
  SolidShape shape = SolidShape::box;
  glm::dvec3 position{0};
  glm::dvec3 size{1};
  std::shared_ptr<const MeshField> mesh;  ///< of SolidShape::mesh, in place already; else null
};

/// Seen from a point.
struct SurfacePoint {
  glm::dvec3 nearest{0};
  double distance = 0;  ///< positive outside, negative inside
};

SurfacePoint surface_near(const Solid& solid, const glm::dvec3& point);

}  // namespace seedmesh
