#pragma once
/// Rotations as in ez-tree, in radians. Orientations are Euler angles about X, Y and Z in this order, as in three.js:
/// ez-tree adds random angles to two of them.
#include <glm/glm.hpp>

#include "core/geom/plant/frame.h"

namespace seedmesh::tree {

struct EzTurn {
  double x = 0, y = 0, z = 0, w = 1;  ///< a unit quaternion
};

/// Returns the rotation with these Euler angles.
EzTurn turn_of_angles(const glm::dvec3& angles);
/// Returns the rotation about an axis of length 1.
EzTurn turn_about(const glm::dvec3& axis, double angle);
/// Returns the smallest rotation from +Y to `to`, which need not have length 1. For -Y it is half a turn about Z.
EzTurn turn_from_up(const glm::dvec3& to);
/// Returns the rotation that applies `b` first and then `a`.
EzTurn product(const EzTurn& a, const EzTurn& b);
/// Interpolates from `a` (`t` is 0) to `b` (1) at constant speed along the shorter arc. Extrapolates for other `t`.
EzTurn between(const EzTurn& a, const EzTurn& b, double t);
/// Turns `a` toward `b` by the angle `step`, at most to `b`. A negative angle turns it away.
EzTurn toward(const EzTurn& a, const EzTurn& b, double step);

/// Returns the Euler angles of a rotation.
glm::dvec3 angles_of(const EzTurn& turn);
/// Returns the frame whose heading is the rotated +Y and whose up vector is the rotated +Z.
Frame frame_of(const EzTurn& turn);

}  // namespace seedmesh::tree
