#pragma once
/// What models of fields and of planetoids are put together from.
#include <string>

#include "core/model/model.h"

namespace seedmesh::terrain {

Material ground_material();
Material water_material();

/// The places of what was added.
int add_material(Model& model, Material material);
int add_mesh(Model& model, std::string name, Mesh mesh, int material);
/// A node below the root, which is the first.
int add_child(Model& model, std::string name, int mesh);

/// "ground", "ground_LOD1", ...
std::string level_name(const std::string& name, int level);

}  // namespace seedmesh::terrain
