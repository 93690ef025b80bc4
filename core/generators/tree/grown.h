#pragma once
/// The model grown: a self-organizing tree. Each year, buds sense the light, and vigour flows from the foot
/// to the buds. Shoots grow toward the light and upward, and branches that gather too little light are shed.
/// After W. Palubicki, K. Horel, S. Longay, A. Runions, B. Lane, R. Mech and P. Prusinkiewicz,
/// "Self-organizing tree models for image synthesis", SIGGRAPH 2009. Light is by shadow propagation (their
/// section 4.1.2).
///
///   sense_light -> gather_light -> divide vigour -> grow_shoots -> shed -> thicken     once a year
///   Plant -> write_grown() -> limbs by thickness, leaves on young wood
///
/// 20,000 internodes take about 0.1 s. The age determines only the number of years that are simulated, so a
/// tree of any age is an earlier state of older ones. If the age has a fraction, shoots of the last year have
/// this fraction of their length.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Writes the skeleton of a tree of this model. Every internode is spent as a module before it grows, and its memory
/// is taken from the budget of the job.
void grow_grown(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
