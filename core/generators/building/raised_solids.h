#pragma once
/// Solids over flat geometry. Each is made once for all shapes with equal geometry.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Makes a prism of a flat solid, along the axis of its normal. The size of the scope does not change.
void make_prism_of(Derivation& d, ShapeState& state, int axis);
/// The same with a pyramid of a flat rectangle or solid.
void make_pyramid_of(Derivation& d, ShapeState& state, int axis);

/// extrude(direction, height): world.up, world.up.flatTop, vertex.normal, face.normal, x, y or z.
void extrude_in(Derivation& d, const Step& step, ShapeState& state, const std::string& direction,
                double height);

}  // namespace seedmesh::building
