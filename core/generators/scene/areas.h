#pragma once
/// Coloured areas on level ground.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {
struct SceneArea;
}

namespace seedmesh::scene {

/// Adds a mesh below the first node for each combination of name, colour, roughness and light, slightly above
/// the ground and below paths. Spends triangles; an exceeded limit points to the area.
void add_areas(Model& model, const std::vector<SceneArea>& areas, Job& job);

}  // namespace seedmesh::scene
