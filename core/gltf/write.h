#pragma once
/// Model -> glTF 2.0. The only room that includes tinygltf.
#include <string>

#include "core/gltf/payload.h"
#include "core/model/model.h"

namespace seedmesh {

enum class Container { glb, gltf, zip };

/// Writes the whole model; takes it over, since the payload points into its arrays. `generator` goes to asset.generator.
/// Every accessor has min and max where glTF wants them, every bufferView a target and an alignment of 4.
/// Throws Stop (through job) before output_bytes is passed.
Payload write(Model model, Container container, const std::string& generator, Job& job);

}  // namespace seedmesh
