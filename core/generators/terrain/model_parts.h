#pragma once
/// Shared helpers for models of fields and planetoids.
#include <optional>
#include <string>

#include "core/model/model.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

Material ground_material(const TerrainParams& params);
Material water_material();

/// Add a part to the model and return its index.
int add_material(Model& model, Material material);
int add_mesh(Model& model, std::string name, Mesh mesh, int material);
/// Adds a node below the root, which is node 0.
int add_child(Model& model, std::string name, int mesh);

/// Returns the name of a level: "ground", "ground_LOD1", ...
std::string level_name(const std::string& name, int level);

}  // namespace seedmesh::terrain
