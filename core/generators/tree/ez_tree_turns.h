#pragma once
/// The rotations of ez-tree, which keeps orientations as angles about X, Y and Z in this order, as three.js does: a
/// random turn is added to two of these angles. Radians.
#include <glm/glm.hpp>

#include "core/geom/plant/frame.h"

namespace seedmesh::tree {

struct EzTurn {
  double x = 0, y = 0, z = 0, w = 1;  ///< a unit quaternion
};

EzTurn turn_of_angles(const glm::dvec3& angles);
EzTurn turn_about(const glm::dvec3& axis, double angle);
/// The smallest turn from +Y to `to`, which need not have length 1. Half a turn about Z for -Y.
EzTurn turn_from_up(const glm::dvec3& to);
EzTurn product(const EzTurn& a, const EzTurn& b);
/// The share `t` of the way from `a` to `b`, the shorter way round; beyond 0 and 1, the way goes on.
EzTurn between(const EzTurn& a, const EzTurn& b, double t);
/// Turns `a` toward `b` by the angle `step`, at most to `b`. A negative angle turns it away.
EzTurn toward(const EzTurn& a, const EzTurn& b, double step);

glm::dvec3 angles_of(const EzTurn& turn);
/// Heading along the turned +Y, up along the turned +Z.
Frame frame_of(const EzTurn& turn);

}  // namespace seedmesh::tree
