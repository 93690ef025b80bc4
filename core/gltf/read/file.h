#pragma once
/// Parses a GLB with tinygltf. Members that a mesh does not need are removed first, so that the library
/// cannot open files, decode images or multiply buffers.
#include <tiny_gltf.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"

namespace seedmesh::gltf {

struct ReadFile {
  tinygltf::Model file;  ///< only what a mesh needs; no images, extensions, skins or animations
  std::vector<std::string> unused_parts;  ///< names of the members that were left out
};

/// Returns an upper bound of the memory for parsing, in bytes. The caller charges it before parsed(). `json`
/// is the JSON chunk of `glb` (checked_json).
std::uint64_t parsing_cost(std::span<const std::byte> glb, std::string_view json);

/// Returns the parsed file. Throws Unreadable.
ReadFile parsed(std::span<const std::byte> glb, std::string_view json, const Job& job);

}  // namespace seedmesh::gltf
