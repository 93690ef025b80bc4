#pragma once
/// Names of files of footprints, and what OpenStreetMap calls them.
#include <string_view>
#include <vector>

namespace seedmesh {

struct FootprintName {
  std::string_view key;   ///< such as "building:levels"
  std::string_view unit;  ///< unit that the values lack: "" or " ft"
};

/// The keys of OpenStreetMap for a name such as "numFloors", "HEIGHT", or "building_l", as shape files shorten it; empty
/// if it has none. Case and the signs between words do not matter.
std::vector<FootprintName> footprint_names(std::string_view name);

}  // namespace seedmesh
