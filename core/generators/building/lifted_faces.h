#pragma once
/// Flat faces in scopes that have a depth. In CityEngine, s() gives the scope of a face a depth, and the face stays
/// flat. Afterwards, i() and primitives fill the whole scope, whereas operations on faces still use the flat face.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Makes the geometry of a flat state an open solid at the low side of the scope along `axis`, the axis of its
/// normal. The caller gives the scope its depth.
void lift_face(Derivation& d, ShapeState& state, int axis);
/// Sets the depth of the scope to 0 if all geometry lies in one plane at right angles to an axis. Does nothing
/// otherwise.
void lower_face(Derivation& d, ShapeState& state);

}  // namespace seedmesh::building
