#pragma once
/// Materials as JSON.
#include <functional>
#include <string>

#include "core/model/model.h"

namespace seedmesh::gltf {

/// A function that returns the number of the texture object for a use, or -1 for none.
using TextureNumber = std::function<int(const TextureUse&)>;

/// Returns the value of KHR_materials_emissive_strength: 1, or the largest component of the emission if that is above
/// 1.
float emissive_strength(const Material& material);

/// Appends a material object, with its members sorted by name and without the defaults of glTF.
void append_material(std::string& out, const Material& material, const TextureNumber& texture_number);

}  // namespace seedmesh::gltf
