#pragma once
/// Planetoids: a sphere whose points are displaced by faults (planes through its centre) or by noise in
/// space.
///
/// The mesh is a cube projected onto a sphere, with squares of equal angles, welded along all edges: one
/// closed surface without seams or poles. The centre is at the origin.
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/faults.h"
#include "core/generators/terrain/noise.h"
#include "core/model/mesh.h"

namespace seedmesh::terrain {

/// The points of the cube's surface, each once, and their heights above the radius in metres.
struct Planet {
  std::int32_t side = 0;  ///< points along an edge of the cube
  double radius = 1;
  Array<glm::vec3> direction;  ///< unit length
  Array<float> height;
};

/// Returns a sphere with 6 (side - 1)^2 + 2 points.
Planet sphere_of(std::int32_t side, double radius, const Job& job);

/// Applies faults on the sphere, each a plane through the centre (Kogovšek 2014, section 5.2.1). Poisson faulting
/// raises one half and lowers the other, so the mean stays 0. Fault formation raises one half. Cost: about 0.7 ns
/// for each point and fault.
void fault_sphere(Planet& planet, const FaultPlan& plan, Rng rng, const Job& job);

/// Applies noise at the points of the sphere. Cost: about 20 ns for each point and octave.
void noise_sphere(Planet& planet, const NoisePlan& plan, Rng rng, const Job& job);

Range range_of(const Planet& planet);

/// The upward direction by which a planet is coloured: away from the centre, or +Y for a rock that lies on the ground.
enum class UpDirection { outward, along_y };

/// Returns the mesh, with area-weighted mean normals. `ground_colors` may be null: no colours. Spends
/// Resource::triangles.
Mesh planet_mesh(const Planet& planet, const GroundColors* ground_colors, UpDirection upward, Rng rng,
                 Job& job);

}  // namespace seedmesh::terrain
