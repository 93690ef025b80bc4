#pragma once
/// The model grown: a self-organizing tree. Year by year, buds sense the light, vigour flows from the foot to the
/// buds, shoots grow toward light and up, and branches that gather too little light are shed. After W. Palubicki,
/// K. Horel, S. Longay, A. Runions, B. Lane, R. Mech and P. Prusinkiewicz, "Self-organizing tree models for image
/// synthesis", SIGGRAPH 2009. Light is by shadow propagation (their section 4.1.2).
///
///   sense_light -> gather_light -> divide vigour -> grow_shoots -> shed -> thicken     once a year
///   Plant -> write_grown() -> limbs by thickness, leaves on young wood
///
/// 20,000 internodes take about 0.1 s. The tree of an age is that of an older one at that age. Within its last year,
/// shoots have the share of their length that the fraction of the age says.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Writes the skeleton of a tree of this model. Every internode is spent as a module before it grows, and its memory
/// is taken from the budget of the job.
void grow_grown(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
