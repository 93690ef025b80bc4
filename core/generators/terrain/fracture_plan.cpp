#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {

FracturePlan fracture_plan(const TerrainParams& params) {
  const TerrainFracture given = params.fracture.value_or(TerrainFracture{});
  FracturePlan plan;
  plan.planes = all_iterations(params);
  plan.axes = {given.axes[0], given.axes[1], given.axes[2]};
  plan.nearest = given.depth[0];
  plan.farthest = given.depth[1];
  plan.bevel = given.bevel;
  plan.strata = given.strata;
  plan.layer = given.layer;
  plan.tilt = given.tilt;
  plan.roughness = amplitude_of(params);
  return plan;
}

}  // namespace seedmesh::terrain
