#pragma once
/// The model of P. Kruszewski, "An algorithm for sculpting trees", Computers and Graphics 23(5), 1999, as
/// described by M. Tunnel (2012). Every limb has a bounding shape into which its own limbs must fit. They
/// leave the limb in whorls, whose gaps become shorter toward the tip and divide the limb into segments. Each
/// segment is bent relative to the one before it and turned about its own axis, which gives a spiral. Radii
/// follow from a taper angle. Limbs end at a number of levels and at a shortest length. Names of parameters
/// are our own, because those of the paper are not public.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Returns the distance from the axis of a limb to its bounding shape, along a ray. The shape reaches from
/// the foot of the limb to its tip. The ray begins on the axis at the distance `from` from the foot.
/// `direction` has unit length; its y is along the axis. The error is at most a millionth of the length.
double distance_in_shape(const TreeLevel& level, double length, double from, const glm::dvec3& direction);

/// Writes the skeleton of a tree of this model.
void grow_sculpt(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
