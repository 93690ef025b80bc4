#pragma once
/// Materials as tinygltf has them.
#include <functional>

#include "core/model/model.h"

namespace tinygltf {
struct Material;
}

namespace seedmesh::gltf {

/// The number of the texture object for a use, -1 for none.
using TextureNumber = std::function<int(const TextureUse&)>;

/// Factors print as short as floats do; what glTF takes as default is left out.
tinygltf::Material material_of(const Material& material, const TextureNumber& texture_number);

}  // namespace seedmesh::gltf
