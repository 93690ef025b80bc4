#pragma once
/// Rule files that come with the program: the blueprints. Each *.cga of this folder is one, by its file's
/// name.
#include <span>
#include <string_view>

namespace seedmesh::building {

struct Blueprint {
  std::string_view name;
  std::string_view rules;  ///< in CityEngine's notation; attributes have ranges
};

/// By name.
std::span<const Blueprint> blueprints();

/// Null for a name that is none.
const Blueprint* blueprint_named(std::string_view name);

}  // namespace seedmesh::building
