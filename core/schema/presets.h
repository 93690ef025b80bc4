#pragma once
/// The presets that are shipped inside, parsed.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/json.h"

namespace seedmesh {

struct Preset {
  Json request;              ///< {generator, seed?, parameters, output?}
  std::string request_text;  ///< the same in the order of its author
};

/// By name. Made once, on first use; safe on any number of threads.
const std::map<std::string, Preset, std::less<>>& preset_requests();

/// The names of all presets, sorted.
std::vector<std::string_view> preset_names();

/// `json` merged over the preset that it names; or as it is, `preset` included, where it names none that
/// there is.
Json with_preset(const Json& json);

}  // namespace seedmesh
