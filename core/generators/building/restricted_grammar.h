#pragma once
/// Restricted kinds of shape grammars: non-erasing and unimarker (Stiny and Gips; Kogovšek 2014, 4.1).
#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// Returns an error for each step that the restriction forbids, at most max_errors: steps that erase, and with
/// `is_unimarker` a second symbol with a rule in one successor. A symbol in a repeated cell, or one that
/// several components may take, counts once.
std::vector<lang::TextError> errors_of_restriction(const Grammar& grammar, bool is_unimarker);

}  // namespace seedmesh::building
