#pragma once
/// The presets that the program contains, parsed.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/json.h"

namespace seedmesh {

struct Preset {
  Json request;              ///< {generator, seed?, parameters, output?}
  std::string request_text;  ///< the same, with members in the order of the file
};

/// All presets by name. Parsed once, on first use; thread-safe.
const std::map<std::string, Preset, std::less<>>& preset_requests();

/// The names of all presets, sorted.
std::vector<std::string_view> preset_names();

/// Returns the request `json` merged over the preset that it names, without its member "preset". Unchanged if it names
/// no preset, or one that does not exist.
Json with_preset(const Json& json);

}  // namespace seedmesh
