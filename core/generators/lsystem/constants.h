#pragma once
/// Resolves the named constants of a grammar: numbers, or expressions over other constants, in any order.
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

/// Evaluates the constants in order of dependency and returns them as bound names. Issues have the pointer
/// "/constants/<name>". They are syntax errors, a cycle with all its names, and a value that is not finite.
/// Random functions in a constant draw from the stream rng.at(name of the constant).
lang::Names resolve_constants(const std::vector<WrittenConstant>& constants, const Rng& rng,
                              std::vector<Issue>& issues);

}  // namespace seedmesh::lsystem
