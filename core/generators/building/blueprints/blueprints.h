#pragma once
/// Rule files that come with the program: the blueprints. Each *.cga file of this directory is one; its name
/// is that of the file.
#include <span>
#include <string_view>

namespace seedmesh::building {

struct Blueprint {
  std::string_view name;
  std::string_view rules;  ///< rules in CityEngine's notation; attributes have ranges
};

/// Returns all blueprints, sorted by name.
std::span<const Blueprint> blueprints();

/// Returns the blueprint with this name; null if there is none.
const Blueprint* blueprint_named(std::string_view name);

}  // namespace seedmesh::building
