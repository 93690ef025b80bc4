#pragma once
/// Parses a GLB with tinygltf, which may neither open files nor decode images nor copy buffers many times.
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

/// Returns an upper bound of the memory for parsing: charge it first. `json` is the JSON chunk of `glb`
/// (checked_json).
std::uint64_t parsing_cost(std::span<const std::byte> glb, std::string_view json);

/// Returns the parsed file. Throws Unreadable.
ReadFile parsed(std::span<const std::byte> glb, std::string_view json, const Job& job);

}  // namespace seedmesh::gltf
