#pragma once
/// Chooses among the rules of a shape, and among their successors.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

// Keys of random numbers, which are combined with the key of a shape: for conditions, and for the choice of a
// successor. The steps of a successor use their index as key. An index is always smaller than these two keys.
constexpr std::uint64_t step_of_conditions = 0xFFFF'FFFF'0001U, step_of_choice = 0xFFFF'FFFF'0002U;

/// Returns the weight of `choice`, at least 0. Percentages count as hundredths. Without a given weight it is 1 -
/// `before`, where `before` is the sum of the earlier weights.
double weight_of(Derivation& d, const Choice& choice, double before);

/// Refuses a sum of weights other than 1 at a byte of the rules if the task has strict weights. Sums of constants are
/// found before the derivation; this finds those that depend on conditions, attributes or random numbers.
void check_sum_of_weights(const Derivation& d, double sum, std::uint32_t offset);

/// Returns the choice that replaces shape `index`. The random number follows from the key of the shape.
/// Returns null if no rule has a true condition.
const Choice* choose(Derivation& d, std::uint32_t index);

}  // namespace seedmesh::building
