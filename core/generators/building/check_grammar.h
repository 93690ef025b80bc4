#pragma once
/// Errors and warnings that need all rules.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Sets the start symbol, and checks weights, arguments of symbols, symbols without a rule, rules that are
/// never used and rules that contain their own symbol without end.
void check_grammar(Parser& p, std::string_view start);

/// Returns the symbols whose weights are constants that do not sum to 1, or to more than 1 beside an else. One error
/// for each.
std::vector<lang::TextError> errors_of_weights(const Grammar& grammar);

}  // namespace seedmesh::building
