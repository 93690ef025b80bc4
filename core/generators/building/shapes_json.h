#pragma once
/// The result of a derivation as JSON, for the response of derive.
#include <nlohmann/json.hpp>

#include "core/base/job.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// Returns the first `most` shapes, parents before children. A shape that was replaced has the text of the first line
/// of the rule that replaced it, and the number of that line. If the rule has several choices, it also has the number
/// of the choice, from 1.
nlohmann::json json_of(const Shapes& shapes, const Grammar& grammar, const RuleText& rules, std::size_t most,
                       const Job& job);
nlohmann::json json_of(const std::map<std::string, Report>& reports);

}  // namespace seedmesh::building
