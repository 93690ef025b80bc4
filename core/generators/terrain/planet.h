#pragma once
/// Planetoids: a sphere whose points are lifted by faults (planes through its centre) or by noise in space.
///
/// The mesh is a cube blown up to a sphere, its squares evened out by angle, welded along all edges: one
/// closed surface without a seam and without poles. Centre at the origin.
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/faults.h"
#include "core/generators/terrain/noise.h"
#include "core/model/mesh.h"

namespace seedmesh::terrain {

/// Points of the cube's surface, each once, and their heights above the radius.
struct Planet {
  std::int32_t side = 0;  ///< points along an edge of the cube
  double radius = 1;
  Array<glm::vec3> direction;  ///< unit length
  Array<float> height;
};

/// 6 (side - 1)^2 + 2 points.
Planet sphere_of(std::int32_t side, double radius, const Job& job);

/// Poisson faulting on the sphere: a plane through the centre lifts one half and sinks the other, so that the
/// mean stays 0. About 0.7 ns a point and fault.
void fault_sphere(Planet& planet, const FaultPlan& plan, Rng rng, const Job& job);

/// Noise at the points of the sphere. About 20 ns a point and octave.
void noise_sphere(Planet& planet, const NoisePlan& plan, Rng rng, const Job& job);

Range range_of(const Planet& planet);

/// Triangles, with normals of their faces' mean; `looks` null: no colours. Spends triangles.
Mesh planet_mesh(const Planet& planet, const Looks* looks, Rng rng, Job& job);

}  // namespace seedmesh::terrain
