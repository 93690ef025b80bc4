#pragma once
/// Split grammars: every shape of a successor stays within the scope of its predecessor (Wonka, Wimmer, Sillion and
/// Ribarsky, "Instant architecture", 2003; Kogovšek 2014, 4.2).
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Checks a new shape against the scope of the shape that it replaces. `offset` is the byte of the rules at which the
/// step that makes the shape begins. A shape that leaves the scope is an error if the task restricts the rules to
/// splits. Otherwise there is a warning if the predecessor is a volume. Blueprints and rule files of CityEngine get
/// no warning. A solid is tested by its points, all other shapes by their scopes.
void check_containment(Derivation& d, std::uint32_t predecessor, const ShapeState& shape,
                       std::uint32_t offset);

}  // namespace seedmesh::building
