#pragma once
/// Errors and warnings that need all rules.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Sets the start symbol, and checks weights, arguments of symbols, symbols without a rule, rules that are
/// never used and rules that cut their own symbol without an end.
void check_grammar(Parser& p, std::string_view start);

}  // namespace seedmesh::building
