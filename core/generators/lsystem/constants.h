#pragma once
/// Named constants of a grammar: numbers, or expressions over other constants, in any order.
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/base/rng.h"
#include "core/lang/expression.h"

namespace seedmesh::lsystem {

struct WrittenConstant {
  std::string name;
  std::variant<double, std::string> value;
};

/// Values by dependency, bound as constants of the names that come back. Faults, each at "/constants/<name>":
/// what the parser says, a cycle (named in full), a value that is no finite number. Random functions draw
/// from `rng` at the constant's name.
lang::Names resolve_constants(const std::vector<WrittenConstant>& constants, const Rng& rng,
                              std::vector<Issue>& issues);

}  // namespace seedmesh::lsystem
