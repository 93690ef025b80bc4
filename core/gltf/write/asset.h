#pragma once
/// The members of a document that describe it as a whole: asset, extras and extensions.
#include <string>
#include <vector>

#include "core/gltf/json_writer.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// `asset` with the generator's name, and with Model::extras and the warnings as extras.
void append_asset(JsonWriter& json, const Model& model, const std::string& generator);

/// `extras`; nothing where there are none.
void append_extras(JsonWriter& json, const std::vector<Extra>& extras);

/// `extensions`: the names of KHR_materials_variants, and convex shapes of OMI_physics_shape with these meshes. Nothing
/// where both are empty.
void append_extensions(JsonWriter& json, const std::vector<std::string>& variants,
                       const std::vector<int>& shapes);

}  // namespace seedmesh::gltf
