#pragma once
/// A body whose faults are to come all at once: a number that is too large for a double does not end the
/// reading.
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/schema/json.h"

namespace seedmesh {

/// As parse_json, but numbers beyond a double (1e999) come as null, each with an Issue at its pointer; of
/// more than a hundred the first. Cost: as parse_json, twice where there is such a number.
Result<Json> parse_body(std::string_view text, std::vector<Issue>& too_large);

}  // namespace seedmesh
