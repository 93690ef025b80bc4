#pragma once
/// Predicts the length of words without deriving them, from the growth matrix of the system (Rozenberg and
/// Salomaa, "The Mathematical Theory of L Systems", 1980).
#include <cstdint>
#include <vector>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

constexpr std::uint64_t saturated = std::uint64_t{1} << 62U;  ///< larger counts are reported as this one

/// Returns a lower bound of the length of the word after `steps` steps, for every outcome of random choices,
/// conditions and contexts. Saturates. Cost: steps times the length of all successors.
std::uint64_t least_modules(const Grammar& grammar, std::uint32_t steps);

/// Returns the number of modules by kind after `steps` steps. Returns an empty vector where random choices,
/// conditions, contexts or cuts decide. Saturates.
std::vector<std::uint64_t> exact_counts(const Grammar& grammar, std::uint32_t steps);

}  // namespace seedmesh::lsystem
