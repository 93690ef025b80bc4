#pragma once
/// Names by which engines recognise collision bodies. docs/output.md has a table for each engine.
#include <string>

#include "core/model/demand.h"

namespace seedmesh {

/// The name of collision body `number` of the mesh named `of`. Unreal requires the mesh's name in it.
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
