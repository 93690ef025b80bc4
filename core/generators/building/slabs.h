#pragma once
/// Pieces of a shape between two planes across an axis of its scope.
#include <optional>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Returns the piece of a shape at a cut along an axis, with a scope fitted to its geometry. With `keeps_slab`, the
/// scope is the whole slab. Empty: the shape has no geometry there. Throws Stop if the solids have too many corners.
std::optional<ShapeState> slab_of(Derivation& d, const ShapeState& state, int axis, const Cut& cut,
                                  bool keeps_slab);

/// Symbols side by side in the notation of 2006, as in `facade(h) ~> floor(h/3) floor(h/3) floor(h/3)`: where the
/// parameter of the predecessor is the height of its scope, and those of the successors add up to it, they are the
/// heights of a stack. These are the cuts along y, from the ground up; empty where this is not so.
std::vector<Cut> stack_of(Derivation& d, const Choice& choice, const ShapeState& state, const Frame& frame);

}  // namespace seedmesh::building
