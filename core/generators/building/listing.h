#pragma once
/// What a derivation made, as JSON: the answer of derive.
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/job.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// The first `most` shapes, parents before children. A shape that was replaced has the rule that did it as
/// written (its first line), the line where that rule begins, and the number of the choice, from 1, where the
/// rule has several. All others have none of the three.
nlohmann::json listed(const Shapes& shapes, const Grammar& grammar, std::string_view rules, std::size_t most,
                      const Job& job);
nlohmann::json listed(const std::map<std::string, Report>& reports);
nlohmann::json listed(const std::vector<Warning>& warnings);

}  // namespace seedmesh::building
