#pragma once
/// Rocks: an ellipsoid that breaks along random planes, with layers of harder and softer stone.
///
/// Each plane cuts off a cap: what remains is convex and has flat facets. Layers are perpendicular to one
/// tilted axis; soft layers recede.
#include <glm/vec3.hpp>

#include "core/base/rng.h"
#include "core/generators/terrain/planet.h"

namespace seedmesh::terrain {

struct FracturePlan {
  int planes = 16;
  glm::dvec3 axes{1, 0.75, 0.85};  ///< half axes of the ellipsoid along x, y and z, as shares of the radius
  /// Least and greatest distance of a plane from the centre, as shares of the distance at which it would touch
  /// the ellipsoid.
  double nearest = 0.62;
  double farthest = 0.95;
  double bevel = 0.04;   ///< width over which edges are worn, as a share of the radius
  double strata = 0;     ///< how far the softest layers recede, as a share of the radius
  double layer = 0.16;   ///< median thickness of a layer, as a share of the radius
  double tilt = 8;       ///< angle between layers and the horizontal, degrees
  double roughness = 0;  ///< amplitude of the noise on the facets, metres
};

/// Writes the heights of a rock. Cost: points times planes, and six octaves of noise a point.
void fracture_sphere(Planet& planet, const FracturePlan& plan, Rng rng, const Job& job);

}  // namespace seedmesh::terrain
