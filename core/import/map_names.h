#pragma once
/// Names of properties in files of footprints, and their keys in OpenStreetMap.
#include <string_view>
#include <vector>

namespace seedmesh {

struct FootprintName {
  std::string_view key;   ///< such as "building:levels"
  std::string_view unit;  ///< unit that the values lack: "" or " ft"
};

/// Returns the keys of OpenStreetMap for a name such as "numFloors" or "HEIGHT", or for a name that shape files
/// shorten, such as "building_l". Empty if there is none. Case and the characters between words are ignored.
std::vector<FootprintName> footprint_names(std::string_view name);

}  // namespace seedmesh
