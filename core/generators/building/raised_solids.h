#pragma once
/// Solids over flat geometry. Each is made once for all shapes with equal geometry.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Makes a prism of a flat solid, along the axis of its normal. The size of the scope does not change.
void make_prism_of(Derivation& d, ShapeState& state, int axis);
/// The same with a pyramid of a flat rectangle or solid.
void make_pyramid_of(Derivation& d, ShapeState& state, int axis);

/// Turns the scope of a face over if the face points away from its axis, as after reverseNormals: extrude and
/// roofs follow the normal of the face.
void face_forward(Derivation& d, const Step& step, ShapeState& state);
/// Returns the faces of a solid whose normals point along an axis (side 1) or against it (side -1), moved to the coordinate 0
/// of the axis and joined. Their normals point along the axis. Without such faces, the result is empty.
Solid outline_along(const Solid& solid, int axis, double side);
/// Returns whether an operation makes a solid or a roof of a face.
bool raises_faces(Op op);
/// Returns whether a shape is a face whose normal is vertical and points up.
bool is_level_face(const Derivation& d, const ShapeState& state);
/// Turns the scope of a shape that an operation has made of a face, as the CGA reference has it: y along the
/// normal of the face, or along the direction of an extrusion, and x as it was, but at right angles to y.
/// `before` is the face.
void stand_up(Derivation& d, const Step& step, const ShapeState& before, ShapeState& state);

/// extrude(direction, height): world.up, world.up.flatTop, vertex.normal, face.normal, x, y or z.
void extrude_in(Derivation& d, const Step& step, ShapeState& state, const std::string& direction,
                double height);

}  // namespace seedmesh::building
