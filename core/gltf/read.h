#pragma once
/// GLB -> Model: a mesh that somebody gives inside a request.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {

/// Reads "data:model/gltf-binary;base64,…" (or application/octet-stream). The model has one node with one
/// mesh, and in it one primitive of triangles for each material that is used: the nodes of the file's scene
/// with their transforms applied, strips and fans turned into triangles, normals of unit length (flat ones
/// where the file has none), TEXCOORD_0 and COLOR_0 where a primitive of that material has them. Materials
/// keep their numbers: colours, metal, roughness, glow, both sides. Triangles without area are left out.
/// Points, lines, images, skins, morph targets and animations are not used, and a warning says so.
///
/// The text is hostile until shown otherwise. Faults point to `pointer` and say what is wrong: no base64, not
/// a GLB of version 2, extensions that are required, accessors out of their buffers, indices out of their
/// vertices, sparse accessors, numbers that are not finite or beyond 1,000,000. Spends Resource::triangles
/// before they are made; arrays and parser are charged to the job. Cost: linear; the parser's JSON has at
/// most 1 MiB and depth 32.
Result<Model> read_glb(std::string_view data_uri, const std::string& pointer, Job& job);

/// The same from the bytes themselves.
Result<Model> read_glb(std::span<const std::byte> bytes, const std::string& pointer, Job& job);

/// Is it the beginning of such a data URI? Cheap: for the check of a request.
bool is_glb_uri(std::string_view text);

}  // namespace seedmesh
