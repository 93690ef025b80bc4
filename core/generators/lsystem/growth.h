#pragma once
/// How long words become, without deriving them: from the growth matrix of the system (Rozenberg and Salomaa,
/// "The Mathematical Theory of L Systems", 1980).
#include <cstdint>
#include <vector>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

constexpr std::uint64_t saturated = std::uint64_t{1}
                                    << 62U;  ///< counts from here on are only known to be this large

/// The least number of modules that the word after `steps` steps can have, whatever chance, conditions and
/// contexts decide. Saturates. Cost: steps times the length of all successors.
std::uint64_t least_modules(const Grammar& grammar, std::uint32_t steps);

/// Number of modules by kind after `steps` steps; empty when chance, conditions, contexts or cuts have a say.
/// Saturates.
std::vector<std::uint64_t> exact_counts(const Grammar& grammar, std::uint32_t steps);

}  // namespace seedmesh::lsystem
