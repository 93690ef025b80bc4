#pragma once
/// Ways as bands on the ground.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {
struct ScenePath;
}

namespace seedmesh::scene {

class Ground;

/// Adds a mesh below the first node for each way that is shown, a little above the ground. `cell`: of the
/// ground's grid; 0 where it is level. Spends triangles; a limit that is passed points to the way.
void add_ways(Model& model, const std::vector<ScenePath>& paths, const Ground& ground, double cell, Job& job);

}  // namespace seedmesh::scene
