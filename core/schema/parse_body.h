#pragma once
/// The parser for request bodies. It continues after a number that is too large for a double, so that all errors of
/// the body are reported together.
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/schema/json.h"

namespace seedmesh {

/// As parse_json, but a number beyond the range of a double (1e999) becomes null and adds an error to `too_large`,
/// for at most 100 numbers. Cost: that of parse_json, and twice that if there is such a number.
Result<Json> parse_body(std::string_view text, std::vector<Issue>& too_large, const JsonLimits& limits = {});

}  // namespace seedmesh
