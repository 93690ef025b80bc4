#pragma once
/// Warnings about parameters of an L-system that are given and have no effect.
#include <vector>

#include "core/base/result.h"
#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

/// Returns the warnings that the schema states (x-applies-when) and those that depend on the grammar: `ring` and
/// `rule_order` without a context, `weights` without a probability, `strict_predecessors` without a predecessor of
/// several modules, `timed` without a rule that uses the age, and `crown_normals` without an organ.
std::vector<Warning> unused_settings(const LsystemParams& params, const Grammar& grammar);

}  // namespace seedmesh::lsystem
