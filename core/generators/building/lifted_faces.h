#pragma once
/// Faces in scopes with a depth. In CityEngine, s() gives the scope of a face a depth, and the face stays flat: i() and
/// primitives fill the scope, and operations on faces find the face.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Makes the geometry of a flat state an open solid at the low side of the scope along `axis`, the axis of its
/// normal. The caller gives the scope its depth.
void lift_face(Derivation& d, ShapeState& state, int axis);
/// Takes the depth of the scope away if all geometry lies in one plane across an axis. Other states stay as they are.
void lower_face(Derivation& d, ShapeState& state);

}  // namespace seedmesh::building
