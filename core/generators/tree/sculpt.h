#pragma once
/// The model of P. Kruszewski, "An algorithm for sculpting trees", Computers and Graphics 23(5), 1999, as M.
/// Tunnel (2012) tells it: a tree is not grown from the root but carved out of a body. Every limb has a
/// bounding shape that its own limbs must fit into. They leave it in whorls, whose gaps shrink toward the tip
/// and cut the limb into segments; each segment is turned off the axis of the one before it and about its own
/// axis, which makes a spiral without chance; a level has a taper angle, from which the radii follow; a
/// number of levels and a shortest limb end it. The paper's own 26 names are not public: these are ours.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// How far a ray from the axis of a limb, `from` its foot, runs inside the limb's bounding shape, which
/// stands on the foot and ends at the tip. `direction` is of unit length, y along the axis. To a millionth of
/// the length.
double room_in_shape(const TreeLevel& level, double length, double from, const glm::dvec3& direction);

void grow_sculpt(const TreeParams& params, const Chances& chances, SkeletonWriter& writer);

}  // namespace seedmesh::tree
