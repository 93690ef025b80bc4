#pragma once
/// Pieces of a shape between two parallel planes at right angles to an axis of its scope.
#include <optional>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Returns the piece of a shape at a cut along an axis, with a scope fitted to its geometry. With `keeps_slab`, the
/// scope is the whole slab. Returns nullopt if the shape has no geometry there. Throws Stop if the solids have too
/// many corners.
std::optional<ShapeState> slab_of(Derivation& d, const ShapeState& state, int axis, const Cut& cut,
                                  bool keeps_slab);

/// In the notation of 2006, symbols side by side can be a stack, as in `facade(h) ~> floor(h/3) floor(h/3)
/// floor(h/3)`. They form a stack if the parameter of the predecessor is the height of its scope, which the
/// parameters of the successors add up to. Returns the cuts of the stack along y, from the ground up; an
/// empty list if there is no stack.
std::vector<Cut> stack_of(Derivation& d, const Choice& choice, const ShapeState& state, const Frame& frame);

}  // namespace seedmesh::building
