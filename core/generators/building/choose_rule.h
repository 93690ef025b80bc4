#pragma once
/// Chooses among the rules of a shape, and among their successors.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

// Numbers of steps that no successor has, for the random numbers of conditions and choices.
constexpr std::uint64_t place_of_conditions = 0xFFFF'FFFF'0001U, place_of_choice = 0xFFFF'FFFF'0002U;

/// The weight of a choice after others whose weights sum to `before`: its own, or what they leave of 1.
double weight_of(Derivation& d, const Choice& choice, double before);

/// The choice that replaces the shape; null: no rule holds.
const Choice* choose(Derivation& d, std::uint32_t index);

}  // namespace seedmesh::building
