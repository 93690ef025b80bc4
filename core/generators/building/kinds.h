#pragma once
/// Shape grammars of restricted kinds.
#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// What keeps rules from being a shape grammar of a restricted kind (Stiny and Gips; Kogovšek 2014, 4.1), as
/// faults: steps that erase, and with `is_unimarker` a second symbol with a rule in one successor. A symbol
/// in a repeated cell, or one that several components may take, counts once.
std::vector<lang::Fault> faults_of_kind(const Grammar& grammar, bool is_unimarker);

}  // namespace seedmesh::building
