#pragma once
/// The glTF library's reading of a GLB, kept from opening files, decoding pictures and multiplying buffers.
#include <tiny_gltf.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"

namespace seedmesh::gltf {

struct ReadFile {
  tinygltf::Model file;                   ///< what a mesh needs; no pictures, extensions, skins or animations
  std::vector<std::string> unused_parts;  ///< members of the file that were left out, by name
};

/// Memory that parsing takes at most: charge it first. `json` is the JSON chunk of `glb` (checked_json).
std::uint64_t parsing_cost(std::span<const std::byte> glb, std::string_view json);

/// Throws Unreadable.
ReadFile parsed(std::span<const std::byte> glb, std::string_view json, const Job& job);

}  // namespace seedmesh::gltf
