#pragma once
/// The members of a document that describe it as a whole: asset, extras and extensions.
#include <string>
#include <vector>

#include "core/gltf/json_writer.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Writes `asset`: generator name, version, and as extras Model::extras and the warnings.
void append_asset(JsonWriter& json, const Model& model, const std::string& generator);

/// Writes `extras`. Writes nothing if there are none.
void append_extras(JsonWriter& json, const std::vector<Extra>& extras);

/// Writes `extensions`: the names of KHR_materials_variants, and one convex OMI_physics_shape for each mesh index in
/// `shapes`. Writes nothing if both are empty.
void append_extensions(JsonWriter& json, const std::vector<std::string>& variants,
                       const std::vector<int>& shapes);

}  // namespace seedmesh::gltf
