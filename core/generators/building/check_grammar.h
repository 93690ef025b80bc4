#pragma once
/// Errors and warnings that need all rules.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Sets the start symbol. Checks weights and arguments of symbols. Reports symbols without a rule, rules that are
/// never used, and rules that contain their own symbol without end.
void check_grammar(Parser& p, std::string_view start);

/// Returns an error for each symbol whose weights are constants with a sum other than 1. Beside an `else`, the
/// sum may be less than 1.
std::vector<lang::TextError> errors_of_weights(const Grammar& grammar);

}  // namespace seedmesh::building
