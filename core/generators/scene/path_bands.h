#pragma once
/// Paths as bands on the ground.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {
struct ScenePath;
}

namespace seedmesh::scene {

class Ground;

/// The appearance of paths: one colour, or the texture of soil with ruts and darker edges.
enum class PathSurface { plain, soil };

/// Adds a mesh for each visible path, slightly above the ground. Its node is a child of the first node. If there are more
/// than 256 paths, adds one mesh for each colour instead. `cell` is the cell size of the ground grid, 0 for level ground.
/// Spends triangles; an exceeded limit points to the path.
void add_path_bands(Model& model, const std::vector<ScenePath>& paths, const Ground& ground, double cell,
                    PathSurface surface, Job& job);

}  // namespace seedmesh::scene
