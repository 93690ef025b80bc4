#pragma once
/// GLB -> Model: a mesh inside a request.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {

/// Reads "data:model/gltf-binary;base64,..." (or application/octet-stream). The result has one node with one
/// mesh and a primitive of triangles for each used material. It contains the scene of the file with all
/// transforms applied. Strips and fans become triangles. Normals have unit length, and are flat where the
/// file has none. TEXCOORD_0 and COLOR_0 are kept where a primitive of that material has them. Materials keep
/// their order, colours, metalness, roughness, emission and double-sidedness. Triangles without area are left
/// out. Points, lines, images, skins, morph targets and animations are left out with a warning.
///
/// The input is untrusted. Errors have the pointer `pointer`. They are invalid base64, no GLB of version 2,
/// required extensions, and sparse accessors. Further errors are accessors outside their buffers, indices
/// beyond the vertices, and numbers that are not finite or beyond 1,000,000. Spends Resource::triangles in
/// advance, and charges arrays and parser to the job. Linear time; the JSON has at most 1 MiB and depth 32.
Result<Model> read_glb(std::string_view data_uri, const std::string& pointer, Job& job);

/// The same for the bytes of the file.
Result<Model> read_glb(std::span<const std::byte> bytes, const std::string& pointer, Job& job);

/// Whether the text begins like such a data URI.
bool is_glb_uri(std::string_view text);

}  // namespace seedmesh
