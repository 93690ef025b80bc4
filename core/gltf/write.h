#pragma once
/// Model -> glTF 2.0. The only room that includes tinygltf.
#include <string>

#include "core/gltf/payload.h"
#include "core/model/model.h"

namespace seedmesh {

/// glb: one binary file. gltf: one JSON file, buffer and images inside as base64. zip: name.gltf, name.bin
/// and textures/*.png stored uncompressed, name being Model::name reduced to file name characters; for models
/// whose nodes have coarser levels also name_LOD1.gltf, name_LOD1.bin and so on, which share the textures.
enum class Container { glb, gltf, zip };

/// Writes the whole model; takes it over, since the payload points into its arrays. `generator` goes to
/// asset.generator. Every accessor has min and max where glTF wants them, every view of vertices or indices
/// its target, everything is aligned to 4. Core glTF 2.0: instances become nodes that share a mesh;
/// extensions (unlit, variants) are never required. What no node shows (meshes, materials, textures, skins)
/// is left out; a model without meshes gives a scene without any. Model::extras and warnings go to
/// asset.extras.
///
/// Promises of the caller, kept by finish(): names are UTF-8, unique and not empty; no number is NaN or
/// infinite; Mesh::bounds fits or is {0,0}. A node with a skin has joints and weights in all its primitives
/// and stands at the root (glTF ignores its transform).
///
/// Throws Stop (through job) before output_bytes is passed, or where the file would reach 4 GiB. Vertex and
/// index data are not copied for glb and zip; base64 takes 4/3 of them and gives each array back when it is
/// encoded.
Payload write(Model model, Container container, const std::string& generator, Job& job);

}  // namespace seedmesh
