#pragma once
/// Names by which engines know collision bodies (docs/output.md has a table for each engine).
#include <string>

#include "core/base/job.h"

namespace seedmesh {

/// The name of body `number` of the mesh `of`, whose own name Unreal wants to find in it.
inline std::string collision_name(CollisionNames names, const std::string& of, std::size_t number) {
  const std::string digits = (number < 10 ? "0" : "") + std::to_string(number);
  switch (names) {
    case CollisionNames::unreal:
      return "UCX_" + of + "_" + digits;
    case CollisionNames::godot:
      return "collision_" + digits + "-convcolonly";
    default:
      return "collision_" + digits;
  }
}

}  // namespace seedmesh
