#pragma once
/// Shared helpers for models of fields and planetoids.
#include <string>

#include "core/model/build.h"
#include "core/model/levels.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

Material ground_material(const TerrainParams& params);
Material water_material();

/// Adds a node below the root, which is node 0, and returns its index.
int add_child(Model& model, std::string name, int mesh);

}  // namespace seedmesh::terrain
