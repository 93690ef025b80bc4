#include "core/generators/building/blueprints/blueprints.h"

#include <algorithm>

namespace seedmesh::building {

const Blueprint* blueprint_named(std::string_view name) {
  const std::span<const Blueprint> all = blueprints();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Blueprint& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace seedmesh::building
